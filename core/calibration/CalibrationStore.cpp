#include "core/calibration/CalibrationStore.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/calibration/StoredCalibrationJson.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {

using nlohmann::json;

/// Closes itself, and with it its lock.
class LockedFile {
public:
    explicit LockedFile(const std::filesystem::path& path)
        : handle_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
        constexpr int kTries = 100;  // 2 s: another program that keeps a calibration takes milliseconds
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
    ~LockedFile() {
        if (handle_ >= 0) ::close(handle_);
    }
    LockedFile(const LockedFile&) = delete;
    LockedFile& operator=(const LockedFile&) = delete;
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

/// Of a line without its own digest.
std::string digestOf(const json& body) { return sha256Hex(body.dump()); }

}  // namespace

StimulatorCalibration linesOf(const StoredCalibration& stored) {
    const auto known = [](const StoredLine& line) {
        CalibrationLine out = line;
        // U is stated in % of the command; what comes out may be less than that.
        double leastDelivered = 1;
        for (const double told : {line.lowest, line.highest})
            leastDelivered = std::min(leastDelivered, line.delivered(told) / told);
        const double relative = line.uncertainty_pct / 100 / leastDelivered;
        out.spread = line.residual ? Spread{relative, *line.residual}
                                   : Spread{std::max(relative, kUnknownSpread.relative), kUnknownSpread.absolute};
        return out;
    };
    StimulatorCalibration lines{known(stored.amplitude)};
    if (stored.interval) lines.interval = known(*stored.interval);
    if (stored.phaseWidth) lines.phaseWidth = known(*stored.phaseWidth);
    if (stored.gap) lines.gap = known(*stored.gap);
    return lines;
}

Result<CalibrationStore> CalibrationStore::open(std::filesystem::path file) {
    CalibrationStore store(std::move(file));
    const auto text = readTextFile(store.file_);
    if (!text) {
        if (text.error().code == ErrorCode::NotFound) return store;
        return failure(text);
    }
    if (auto done = store.read(*text); !done) return failure(done);
    return store;
}

Result<void> CalibrationStore::read(std::string_view text) {
    all_.clear();
    head_.clear();
    wholeBytes_ = 0;
    cut_ = false;
    std::size_t line = 0;
    while (!text.empty()) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) {
            cut_ = true;  // a crash while it was written: it was never confirmed
            return {};
        }
        ++line;
        const auto wrong = [&](std::string_view why) {
            return fail(ErrorCode::ParseError, "{}:{}: {}; an unchanged line of this program was expected",
                        file_.string(), line, why);
        };
        auto parsed = parseJson(text.substr(0, end), "the line");
        if (!parsed) return wrong("this is no calibration: " + parsed.error().message);
        json& body = *parsed;
        if (!body.is_object() || !body.contains("sha256") || !body.contains("previous")) {
            return wrong("this is no calibration");
        }
        const json stated = body["sha256"];
        body.erase("sha256");
        const auto digest = digestOf(body);
        if (stated != digest) return wrong("its digest does not fit what it says");
        if (body["previous"] != head_) return wrong("the line before it is not the one that it followed");
        auto calibration = storedCalibrationFrom(body.value("calibration", json()));
        if (!calibration) return wrong(calibration.error().message);
        all_.push_back(std::move(*calibration));
        head_ = digest;
        wholeBytes_ += end + 1;
        text.remove_prefix(end + 1);
    }
    return {};
}

Result<void> CalibrationStore::add(const StoredCalibration& calibration) {
    if (auto sane = check(calibration); !sane) return sane;
    if (auto known = checkProvenance(calibration); !known) return known;
    for (const auto& time : kStoredTimes) {
        if (calibration.*time.line) continue;
        return fail(ErrorCode::InvalidArgument, "calibration of {}: no {}; all four quantities were expected",
                    calibration.serial, time.title);
    }
    std::error_code failed;
    if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), failed);
    const LockedFile locked(file_);
    if (!locked.open()) {
        const bool held = errno == EWOULDBLOCK;
        return fail(ErrorCode::Io, "{} cannot be written: {}; a writable file was expected", file_.string(),
                    held ? "another program has kept it locked for 2 s" : std::strerror(errno));
    }
    // Another process may have added one since.
    const auto text = readTextFile(file_);
    if (!text) return failure(text);
    if (auto done = read(*text); !done) return done;
    json body = {{"calibration", toJson(calibration)}, {"previous", head_}};
    const auto digest = digestOf(body);
    body["sha256"] = digest;
    const std::string line = body.dump() + '\n';
    if (!locked.write(wholeBytes_, line)) {
        return fail(ErrorCode::Io, "{} cannot be written: {}", file_.string(), std::strerror(errno));
    }
    all_.push_back(calibration);
    head_ = digest;
    wholeBytes_ += line.size();
    cut_ = false;
    return {};
}

const StoredCalibration* CalibrationStore::latest(std::string_view serial, std::string_view unit) const {
    for (auto at = all_.rbegin(); at != all_.rend(); ++at) {
        if (at->serial == serial && at->unit == unit) return &*at;
    }
    return nullptr;
}

const StoredCalibration* CalibrationStore::proven(std::string_view serial, std::string_view unit,
                                                  bool simulated) const {
    for (auto at = all_.rbegin(); at != all_.rend(); ++at) {
        if (at->serial != serial || at->unit != unit || (at->simulated && !simulated)) continue;
        if (checkProvenance(*at)) return &*at;
    }
    return nullptr;
}

Result<StoredCalibration> CalibrationStore::valid(std::string_view serial, std::string_view unit, CalibrationDate day,
                                                  bool simulated) const {
    const auto* found = latest(serial, unit);
    if (found == nullptr) {
        return fail(ErrorCode::NotFound, "stimulator {} is not calibrated in {}; a stimulator calibration is expected",
                    serial.empty() ? "without a serial" : serial, unit);
    }
    if (found->simulated && !simulated) {
        return fail(ErrorCode::NotFound,
                    "stimulator {} was calibrated on a simulated bench only, on {}; one on the "
                    "real bench is expected",
                    serial, dateText(found->made));
    }
    if (const auto known = checkProvenance(*found); !known) {
        return fail(ErrorCode::NotFound, "{}", known.error().message);
    }
    for (const auto& time : kStoredTimes) {
        if (found->*time.line) continue;
        return fail(ErrorCode::NotFound,
                    "the calibration of stimulator {} of {} is without its {}; one of amplitude, interval, phase width "
                    "and gap is expected",
                    serial, dateText(found->made), time.title);
    }
    if (day < found->made || day > found->validUntil) {
        return fail(ErrorCode::NotFound,
                    "the calibration of stimulator {} holds from {} to {} and today is {}; a newer "
                    "one is expected",
                    serial, dateText(found->made), dateText(found->validUntil), dateText(day));
    }
    return *found;
}

std::filesystem::path calibrationFile() {
    const char* data = std::getenv("XDG_DATA_HOME");
    if (data != nullptr && *data != '\0') return std::filesystem::path(data) / "tactoscope" / "calibrations.jsonl";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr ? home : ".") / ".local" / "share" / "tactoscope" /
           "calibrations.jsonl";
}

}  // namespace tacto
