#include "core/calibration/ChainedLines.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/ProgramStart.h"
#include "core/base/WholeFile.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {

/// Closes the file, and so releases its lock, when destroyed.
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

    /// Replaces everything after `keep` with `text`; the data are on disk when this returns.
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

/// Returns the digest of a line without its "sha256".
std::string digestOf(const nlohmann::json& line) { return sha256Hex(dumpJson(line)); }

}  // namespace

std::filesystem::path ChainedLines::noteFile() const { return file_.string() + ".end"; }

Result<std::optional<ChainedLines::End>> ChainedLines::notedEnd() const {
    const auto text = readTextFile(noteFile());
    if (!text && text.error().code == ErrorCode::NotFound) return std::nullopt;
    if (!text) return failure(text);
    const auto note = parseJson(*text, noteFile().string());
    if (!note) return failure(note);
    if (note->is_object() && note->size() == 2 && note->contains("bytes") && note->contains("sha256") &&
        (*note)["bytes"].is_number_unsigned() && (*note)["sha256"].is_string())
        return End{(*note)["bytes"].get<std::size_t>(), (*note)["sha256"].get<std::string>()};
    return fail(ErrorCode::ParseError, "{} does not say where {} ends; a note of this program was expected",
                noteFile().string(), file_.string());
}

Result<void> ChainedLines::noteEnd() const {
    const auto text = dumpJson({{"bytes", end_.bytes}, {"sha256", end_.head}}) + '\n';
    if (auto written = namedAs(noteFile(), writeWholeFile(noteFile(), text)); !written) return written;
    syncFolderOf(noteFile());
    return {};
}

Result<void> ChainedLines::read(const std::function<Result<void>(const nlohmann::json& line)>& take) {
    end_ = {};
    cut_ = false;
    const auto noted = notedEnd();  // read before the lines: a writer writes its lines first, and may append now
    if (!noted) return failure(noted);
    hasNote_ = noted->has_value();
    const auto content = readTextFile(file_);
    if (!content && content.error().code != ErrorCode::NotFound) return failure(content);
    return readLines(content ? *content : "", *noted, take);
}

Result<void> ChainedLines::readLines(std::string_view text, const std::optional<End>& noted,
                                     const std::function<Result<void>(const nlohmann::json& line)>& take) {
    bool reached = !noted || *noted == end_;
    bool isNoted = false;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const auto length = text.find('\n');
        if (length == std::string_view::npos) {
            cut_ = true;  // cut by a crash while it was written, so it was never confirmed
            break;
        }
        const auto wrong = [&](std::string_view why) {
            return fail(ErrorCode::ParseError, "{}:{}: {}; an unchanged line of this program was expected",
                        file_.string(), number, why);
        };
        auto line = parseJson(text.substr(0, length), "the line");
        if (!line) return wrong(fmt::format("this is not a {}: {}", what_, line.error().message));
        if (!line->is_object() || !line->contains("sha256") || !line->contains("previous")) {
            return wrong("this is not a " + what_);
        }
        const nlohmann::json stated = (*line)["sha256"];
        line->erase("sha256");
        const auto digest = digestOf(*line);
        if (stated != digest) return wrong("its digest does not fit what it says");
        if ((*line)["previous"] != end_.head) return wrong("the line before it is not the one that it followed");
        isNoted = line->erase("end_noted") > 0 || isNoted;
        if (const auto taken = take(*line); !taken) return wrong(taken.error().message);
        end_ = {end_.bytes + length + 1, digest};
        reached = reached || *noted == end_;
        text.remove_prefix(length + 1);
    }
    if (!reached) {
        return fail(ErrorCode::ParseError,
                    "{} ends at byte {} where {} says {}: lines are missing; put it back from your copy",
                    file_.string(), end_.bytes, noteFile().string(), noted->bytes);
    }
    if (isNoted && !noted) {
        return fail(ErrorCode::ParseError, "{} is missing, so lines of {} may be; put both back from your copy",
                    noteFile().string(), file_.string());
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
    // Note the end before the first line that claims a note: a crash in between would make the note seem lost.
    if (!hasNote_) {
        if (const auto first = noteEnd(); !first) return first;
        hasNote_ = true;
    }
    body->erase("sha256");  // the line's own digest must not be part of the digested text
    (*body)["end_noted"] = true;
    (*body)["previous"] = end_.head;
    const auto digest = digestOf(*body);
    (*body)["sha256"] = digest;
    const std::string text = dumpJson(*body) + '\n';
    if (!lock.write(end_.bytes, text)) {
        return fail(ErrorCode::Io, "{} cannot be written: {}", file_.string(), std::strerror(errno));
    }
    end_ = {end_.bytes + text.size(), digest};
    cut_ = false;
    return noteEnd();
}

std::filesystem::path labFile(std::string_view name) { return dataFolder() / name; }

}  // namespace tacto
