#include "core/formats/ByteFile.h"

#include <system_error>

#include "core/base/Csv.h"
#include "core/formats/CaptureFormat.h"

namespace tacto {

ByteFile::ByteFile(std::unique_ptr<std::FILE, Close> file, std::string name, std::uint64_t size)
    : file_(std::move(file)), name_(std::move(name)), size_(size) {}

Result<ByteFile> ByteFile::open(const std::filesystem::path& path) {
    if (auto plain = checkPlainFile(path); !plain) return failure(plain);
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) return fail(ErrorCode::Io, "{} cannot be read: {}", path.string(), error.message());
    std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) return fail(ErrorCode::Io, "{} cannot be opened for reading", path.string());
    // Readers ask for large pieces: a second buffer would only be copied through.
    std::setvbuf(file.get(), nullptr, _IONBF, 0);
    return ByteFile(std::move(file), path.string(), size);
}

Result<std::size_t> ByteFile::read(char* into, std::size_t count) {
    const auto got = std::fread(into, 1, count, file_.get());
    if (got < count && std::ferror(file_.get()) != 0)
        return fail(ErrorCode::Io, "{} cannot be read any further", name_);
    return got;
}

Result<void> ByteFile::seek(std::uint64_t position) {
    if (fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET) != 0) {
        return fail(ErrorCode::Io, "{} cannot be read at byte {}", name_, position);
    }
    return {};
}

Result<std::string> readHead(const std::filesystem::path& path) {
    auto file = ByteFile::open(path);
    if (!file) return failure(file);
    std::string head(kHeadBytes, '\0');
    const auto got = file->read(head.data(), head.size());
    if (!got) return failure(got);
    head.resize(*got);
    return head;
}

}  // namespace tacto
