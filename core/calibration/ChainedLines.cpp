#include "core/calibration/ChainedLines.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {

/// Closes itself, and with it its lock.
class Lock {
public:
    explicit Lock(const std::filesystem::path& path)
        : handle_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
        constexpr int kTries = 100;  // 2 s: another program that appends a line takes milliseconds
        for (int i = 1; handle_ >= 0 && ::flock(handle_, LOCK_EX | LOCK_NB) != 0; ++i) {
            if (errno == EINTR || (errno == EWOULDBLOCK && i < kTries)) {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                continue;
            }
            ::close(handle_);
            handle_ = -1;
            errno = EWOULDBLOCK;
        }
    }
    ~Lock() {
        if (handle_ >= 0) ::close(handle_);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    [[nodiscard]] bool open() const noexcept { return handle_ >= 0; }

    /// Everything after `keep` is replaced by `text`, on disk when this returns.
    [[nodiscard]] bool write(std::size_t keep, std::string_view text) const {
        if (::ftruncate(handle_, static_cast<off_t>(keep)) != 0) return false;
        auto at = static_cast<off_t>(keep);
        while (!text.empty()) {
            const auto wrote = ::pwrite(handle_, text.data(), text.size(), at);
            if (wrote < 0 && errno == EINTR) continue;
            if (wrote <= 0) return false;
            at += wrote;
            text.remove_prefix(static_cast<std::size_t>(wrote));
        }
        return ::fsync(handle_) == 0;
    }

private:
    int handle_;
};

/// The digest of a line without its own digest.
std::string digestOf(const nlohmann::json& line) { return sha256Hex(dumpJson(line)); }

}  // namespace

Result<void> ChainedLines::read(const std::function<Result<void>(const nlohmann::json& line)>& take) {
    head_.clear();
    wholeBytes_ = 0;
    cut_ = false;
    const auto content = readTextFile(file_);
    if (!content) {
        if (content.error().code == ErrorCode::NotFound) return {};
        return failure(content);
    }
    std::string_view text = *content;
    std::size_t number = 0;
    while (!text.empty()) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) {
            cut_ = true;  // a crash while it was written: it was never confirmed
            return {};
        }
        ++number;
        const auto wrong = [&](std::string_view why) {
            return fail(ErrorCode::ParseError, "{}:{}: {}; an unchanged line of this program was expected",
                        file_.string(), number, why);
        };
        auto line = parseJson(text.substr(0, end), "the line");
        if (!line) return wrong(fmt::format("this is no {}: {}", what_, line.error().message));
        if (!line->is_object() || !line->contains("sha256") || !line->contains("previous")) {
            return wrong("this is no " + what_);
        }
        const nlohmann::json stated = (*line)["sha256"];
        line->erase("sha256");
        const auto digest = digestOf(*line);
        if (stated != digest) return wrong("its digest does not fit what it says");
        if ((*line)["previous"] != head_) return wrong("the line before it is not the one that it followed");
        if (const auto taken = take(*line); !taken) return wrong(taken.error().message);
        head_ = digest;
        wholeBytes_ += end + 1;
        text.remove_prefix(end + 1);
    }
    return {};
}

Result<void> ChainedLines::append(const std::function<Result<nlohmann::json>()>& line) {
    std::error_code failed;
    if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), failed);
    const Lock lock(file_);
    if (!lock.open()) {
        const bool held = errno == EWOULDBLOCK;
        return fail(ErrorCode::Io, "{} cannot be written: {}; a writable file was expected", file_.string(),
                    held ? "another program has kept it locked for 2 s" : std::strerror(errno));
    }
    auto body = line();
    if (!body) return failure(body);
    (*body)["previous"] = head_;
    const auto digest = digestOf(*body);
    (*body)["sha256"] = digest;
    const std::string text = dumpJson(*body) + '\n';
    if (!lock.write(wholeBytes_, text)) {
        return fail(ErrorCode::Io, "{} cannot be written: {}", file_.string(), std::strerror(errno));
    }
    head_ = digest;
    wholeBytes_ += text.size();
    cut_ = false;
    return {};
}

std::filesystem::path labFile(std::string_view name) {
    const char* data = std::getenv("XDG_DATA_HOME");
    if (data != nullptr && *data != '\0') return std::filesystem::path(data) / "tactoscope" / name;
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr ? home : ".") / ".local" / "share" / "tactoscope" / name;
}

}  // namespace tacto
