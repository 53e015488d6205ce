#include "core/formats/TextBlocks.h"

#include <algorithm>
#include <cstring>
#include <system_error>

#include "core/base/Csv.h"
#include "core/formats/CaptureFormat.h"

namespace tacto {

TextBlocks::TextBlocks(std::optional<ByteFile> file, std::string_view text, std::string name)
    : file_(std::move(file)), text_(text), name_(std::move(name)), buffer_(kBlockBytes + 1) {}

Result<TextBlocks> TextBlocks::ofFile(const std::filesystem::path& path) {
    auto file = ByteFile::open(path);
    if (!file) return failure(file);
    return TextBlocks(std::move(*file), {}, path.string());
}

TextBlocks TextBlocks::ofText(std::string_view text, std::string_view name) {
    return TextBlocks(std::nullopt, text, std::string(name));
}

Result<std::size_t> TextBlocks::fillRaw(char* into, std::size_t count) {
    auto got = file_ ? file_->read(into, count)
                     : Result<std::size_t>(text_.copy(into, count, static_cast<std::size_t>(taken_)));
    if (got) taken_ += *got;
    return got;
}

Result<std::size_t> TextBlocks::fillFromUtf16(char* into, std::size_t count) {
    const std::size_t wanted = count / kUtf8PerUtf16 * 2;
    if (raw_.size() < wanted) {
        const auto had = raw_.size();
        raw_.resize(wanted);
        const auto got = fillRaw(raw_.data() + had, wanted - had);
        if (!got) return got;
        raw_.resize(had + *got);
    }
    std::string text;
    const auto used = appendAsUtf8(std::string_view(raw_).substr(0, wanted), *order_, text);
    raw_.erase(0, used);
    return text.copy(into, count);
}

Result<std::size_t> TextBlocks::fill(char* into, std::size_t count) {
    if (order_) return fillFromUtf16(into, count);
    const bool first = taken_ == 0;
    auto got = fillRaw(into, count);
    if (!got || !first) return got;
    order_ = utf16OrderOf({into, *got});
    if (!order_) return got;
    raw_.assign(into + 2, *got - 2);
    return fillFromUtf16(into, count);
}

Result<std::string_view> TextBlocks::next() {
    char* const begin = buffer_.data();
    std::memmove(begin, begin + used_, held_ - used_);
    held_ -= used_;
    used_ = 0;
    constexpr std::size_t kRoom = 2 * kUtf8PerUtf16;  // room for the two UTF-16 units of one character
    while (!ended_ && kBlockBytes - held_ >= kRoom) {
        const bool first = taken_ == 0;
        const auto got = fill(begin + held_, kBlockBytes - held_);
        if (!got) return failure(got);
        held_ += *got;
        if (*got == 0) ended_ = true;
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (first && std::string_view(begin, held_).starts_with(kByteOrderMark)) {
            std::memmove(begin, begin + kByteOrderMark.size(), held_ - kByteOrderMark.size());
            held_ -= kByteOrderMark.size();
        }
    }
    std::string_view held(begin, held_);
    if (ended_) {
        if (!held.empty() && held.back() != '\n') begin[held_++] = '\n';
        used_ = held_;
    } else {
        const auto end = held.rfind('\n');
        if (end == std::string_view::npos) {
            return fail(ErrorCode::ParseError, "{}: a line is longer than {} bytes; a table of text was expected",
                        name_, kBlockBytes);
        }
        used_ = end + 1;
    }
    return std::string_view(begin, used_);
}

Result<void> TextBlocks::rewind() {
    held_ = used_ = 0;
    taken_ = 0;
    ended_ = false;
    order_.reset();
    raw_.clear();
    return file_ ? file_->seek(0) : Result<void>{};
}

double TextBlocks::fraction() const noexcept {
    return size() == 0 ? 1 : std::min(1.0, static_cast<double>(taken_) / static_cast<double>(size()));
}

ByteFile::ByteFile(std::unique_ptr<std::FILE, Close> file, std::string name, std::uint64_t size)
    : file_(std::move(file)), name_(std::move(name)), size_(size) {}

Result<ByteFile> ByteFile::open(const std::filesystem::path& path) {
    if (auto plain = checkPlainFile(path); !plain) return failure(plain);
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) return fail(ErrorCode::Io, "{} cannot be read: {}", path.string(), error.message());
    std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) return fail(ErrorCode::Io, "{} cannot be opened for reading", path.string());
    // Readers ask for large pieces, so a second buffer would only cause another copy.
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
