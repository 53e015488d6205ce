#include "core/safety/UnitRecord.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <type_traits>
#include <unistd.h>

namespace tacto {

namespace {

constexpr std::uint64_t kMagic = 0x31'74'69'6e'75'74'63'61;  // "actunit1"
constexpr double kMostStretch = 2;                           // as the gate: how much longer a window may last

/// FNV-1a over the bytes of what is checked. Against a torn or damaged record, not against a forger.
std::uint64_t checksumOf(const void* data, std::size_t size) noexcept {
    std::uint64_t sum = 0xcbf29ce484222325;
    for (const auto *at = static_cast<const unsigned char*>(data), *end = at + size; at != end; ++at)
        sum = (sum ^ *at) * 0x100000001b3;
    return sum;
}

/// A part of the record: its content, and the checksum that is taken away before the content changes.
template <class Content>
struct Checked {
    Content content{};
    std::uint64_t sum = 0;
    static_assert(std::is_trivially_copyable_v<Content>);

    [[nodiscard]] bool sound() const noexcept { return sum == checksumOf(&content, sizeof content); }
    void write(const Content& newer) noexcept {
        std::atomic_ref(sum).store(0, std::memory_order_relaxed);
        std::atomic_signal_fence(std::memory_order_seq_cst);  // The process may end between any two stores
        content = newer;
        std::atomic_signal_fence(std::memory_order_seq_cst);
        std::atomic_ref(sum).store(checksumOf(&content, sizeof content), std::memory_order_relaxed);
    }
};

template <std::size_t N>
void copyText(std::array<char, N>& into, std::string_view text) noexcept {
    into.fill(0);
    std::copy_n(text.begin(), std::min(text.size(), N - 1), into.begin());
}
template <std::size_t N>
std::string_view textIn(const std::array<char, N>& from) noexcept {
    return {from.data(), ::strnlen(from.data(), N)};
}

struct Head {
    std::uint64_t magic = kMagic;
    std::uint64_t trainSize = 0;  // another build may hold other numbers
    std::array<char, 48> boot{};
    std::int64_t quietUntil_ns = 0;  // since boot
    std::int64_t wall_s = 0;         // when it was opened
    std::int64_t process = 0;
};

/// Times since boot.
struct Train {
    std::uint64_t sequence = 0;  // 0: none
    std::int64_t earliest_ns = 0, latest_ns = 0, wall_s = 0;
    double hz = 0;
    std::array<TrainSums, 4> sums{};  // of the load range in 1 s and 5 s, of 500 ohm in 1 s and 5 s
    std::array<double, 2> left_V{};
    std::array<std::int64_t, 2> leftAt_ns{};
};

constexpr Checked<Train> kEmpty{};  // All bits 0, as a new file is

struct Fault {
    std::uint64_t causes = 0;
    std::int64_t wall_s = 0;
    std::array<char, 160> reason{};
};

std::string fileNameOf(std::string_view unit) {
    std::string name;
    for (const char c : unit) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-';
        name += plain ? c : '_';
    }
    // Two units may differ in what a file name cannot hold.
    return fmt::format("{}-{:08x}.unit", name.substr(0, 80), checksumOf(unit.data(), unit.size()) & 0xffffffff);
}

/// "tactoscope-cli (process 4711)".
std::string holderOf(int file) {
    Checked<Head> head;
    if (::pread(file, &head, sizeof head, 0) != static_cast<ssize_t>(sizeof head) || !head.sound())
        return "another process";
    std::string program;
    std::ifstream in(fmt::format("/proc/{}/comm", head.content.process));
    std::getline(in, program);
    return fmt::format("{} (process {})", program.empty() ? "a program" : program, head.content.process);
}

/// True when `folder` has kept the same records for long: a unit without one there was not driven in that time. A
/// folder that was made, moved here or emptied a moment ago proves nothing about a unit that it does not know.
bool unchangedForLong(const std::filesystem::path& folder, const SystemTime& time) {
    struct stat about {};
    if (::stat(folder.c_str(), &about) != 0) return false;
    return time.wall().time_since_epoch().count() - about.st_mtim.tv_sec >= UnitRecord::kLongAgo.count();
}

tl::unexpected<Error> cannot(const std::filesystem::path& path) {
    return fail(ErrorCode::Io,
                "the record of what this unit has delivered, {}, cannot be kept: {}. Without it the unit is not driven",
                path.string(), std::strerror(errno));
}

}  // namespace

struct UnitRecord::Map {
    Checked<Head> head;
    Checked<Fault> fault;
    std::array<Checked<Train>, kTrains> trains;
};

Result<std::unique_ptr<UnitRecord>> UnitRecord::open(const std::filesystem::path& folder, std::string_view unit,
                                                     const Clock& clock, const SystemTime& time) {
    const bool settled = unchangedForLong(folder, time);
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    const auto path = folder / fileNameOf(unit);
    int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    const bool made = file >= 0;
    // A link would lead to a file of another purpose, and a pipe would wait.
    if (!made && errno == EEXIST) file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return cannot(path);
    const auto giveUp = [&](tl::unexpected<Error> why) {
        if (made) ::unlink(path.c_str());
        ::close(file);
        return why;
    };
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
        const bool held = errno == EWOULDBLOCK;
        tl::unexpected<Error> why =
            held ? fail(ErrorCode::Device, "{} is driven by {}; end that first. Nothing was delivered here", unit,
                        holderOf(file))
                 : cannot(path);
        ::close(file);
        return why;
    }
    struct stat about {};
    if (::fstat(file, &about) != 0) return giveUp(cannot(path));
    if (!S_ISREG(about.st_mode) || about.st_nlink != 1) {
        return giveUp(fail(ErrorCode::Io,
                           "the record of what this unit has delivered, {}, is no file of its own (a link, a pipe); "
                           "remove it. Without a record the unit is not driven",
                           path.string()));
    }
    const bool whole = made || about.st_size == static_cast<off_t>(sizeof(Map));
    // Allocated now: a full disk is found here and not in the middle of a run.
    if (const int error = ::posix_fallocate(file, 0, sizeof(Map)); error != 0) {
        errno = error;
        return giveUp(cannot(path));
    }
    void* at = ::mmap(nullptr, sizeof(Map), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0);
    if (at == MAP_FAILED) return giveUp(cannot(path));
    auto& map = *static_cast<Map*>(at);
    if (!whole) map.head.sum = map.fault.sum = 0;  // What is missing is not nothing
    if (made) map.fault.write({});
    if (made && settled) map.head.write({.trainSize = sizeof(Train)});
    return std::unique_ptr<UnitRecord>(new UnitRecord(file, map, clock, time, !made || settled));
}

UnitRecord::UnitRecord(int file, Map& map, const Clock& clock, const SystemTime& time, bool pastKept)
    : file_(file), map_(map), clock_(clock), time_(time), quietUntil_(clock.now()) {
    takeOver(pastKept);
}

UnitRecord::~UnitRecord() {
    ::munmap(&map_, sizeof(Map));
    ::close(file_);  // and with it the lock
}

Instant UnitRecord::onClock(Instant sinceBoot) const noexcept { return clock_.now() + (sinceBoot - time_.sinceBoot()); }

/// Decides whether what stands in the record is believed, and makes it this process's. `pastKept` is false for a
/// record that was made now where an earlier one may have been.
void UnitRecord::takeOver(bool pastKept) {
    const Instant boot = time_.sinceBoot();
    const auto wall = time_.wall().time_since_epoch().count();
    const std::string bootId = time_.boot();
    const Checked<Head> before = map_.head;
    std::string_view why;
    bool keep = false;  // the trains are of this start of the computer
    if (!before.sound() || before.content.magic != kMagic || before.content.trainSize != sizeof(Train)) {
        why = pastKept ? "its record is damaged or of another version"
                       : "there is no record of it, and the folder of the records was made or changed just now";
    } else {
        auto newestWall = before.content.wall_s;
        auto newest = Instant(before.content.quietUntil_ns) - kRest;
        bool whole = true;
        std::uint64_t last = 0;
        for (const auto& train : map_.trains) {
            if (std::memcmp(&train, &kEmpty, sizeof kEmpty) == 0) continue;
            whole = whole && train.sound();
            last = std::max(last, train.content.sequence);
            newestWall = std::max(newestWall, train.content.wall_s);
            newest = std::max(newest, Instant(train.content.earliest_ns));
        }
        next_ = last + 1;
        const bool neverUsed = before.content.process == 0;
        keep = neverUsed || (!bootId.empty() && textIn(before.content.boot) == bootId);
        if (!whole) {
            why = "its record was torn, as when a program ends while it writes";
        } else if (keep && newest > boot) {
            why = "its record is from a time that has not come";
        } else if (!keep && !(wall - newestWall >= kLongAgo.count())) {
            why = "its record is from before the computer was started, and the wall clock does not say how long ago";
        }
    }
    Head head{.trainSize = sizeof(Train), .wall_s = wall, .process = ::getpid()};
    copyText(head.boot, bootId);
    head.quietUntil_ns = !why.empty() ? (boot + kRest).count() : keep ? before.content.quietUntil_ns : 0;
    if (!why.empty() || !keep) {
        // Until the new head stands, the record does not check.
        std::atomic_ref(map_.head.sum).store(0);
        for (auto& train : map_.trains) train = {};
        next_ = 1;
    }
    if (!map_.fault.sound()) {
        // As a fault of the device: a reset asks it again, and arming begins with a check pulse.
        Fault unknown{.causes = 1U << static_cast<unsigned>(FaultCause::DeviceFault), .wall_s = wall};
        copyText(unknown.reason, "the record of this unit is damaged; whether it was left in a fault is not known");
        map_.fault.write(unknown);
    }
    map_.head.write(head);
    if (Instant(head.quietUntil_ns) > boot) {
        why_ = why.empty() ? "a program before this one did not know it either" : why;
        quietUntil_ = onClock(Instant(head.quietUntil_ns));
    }
}

ResidualVoltages UnitRecord::replay(ExposureMeter& meter) const noexcept {
    const Instant boot = time_.sinceBoot();
    const Instant window = toInstant(ExposureMeter::kLongestWindow * kMostStretch);
    ResidualVoltages left;
    if (next_ == 1) return left;
    // In the order in which they were booked; what is overwritten is older than any window.
    const std::uint64_t oldest = next_ > kTrains ? next_ - kTrains : 1;
    for (std::uint64_t sequence = oldest; sequence < next_; ++sequence) {
        const Train& train = map_.trains[sequence % kTrains].content;
        if (train.sequence != sequence) continue;
        for (std::size_t k = 0; k < left.size(); ++k)
            left[k] = {train.left_V[k], onClock(Instant(train.leftAt_ns[k]))};  // The newest counts
        if (Instant(train.latest_ns) + window <= boot) continue;
        BookedTrain booked;
        booked.earliest = onClock(Instant(train.earliest_ns));
        booked.latest = onClock(Instant(train.latest_ns));
        booked.hz = train.hz;
        booked.overRange.in1s = train.sums[0];
        booked.overRange.in5s = train.sums[1];
        booked.at500.in1s = train.sums[2];
        booked.at500.in5s = train.sums[3];
        meter.book(booked);
    }
    return left;
}

void UnitRecord::book(const BookedTrain& booked, const ResidualVoltages& left) noexcept {
    // Taken anew each time: the clock stands still while the computer sleeps.
    const Instant offset = time_.sinceBoot() - clock_.now();
    Train train;
    train.sequence = next_;
    train.earliest_ns = (booked.earliest + offset).count();
    train.latest_ns = (booked.latest + offset).count();
    train.wall_s = time_.wall().time_since_epoch().count();
    train.hz = booked.hz;
    train.sums = {booked.overRange.in1s, booked.overRange.in5s, booked.at500.in1s, booked.at500.in5s};
    for (std::size_t k = 0; k < left.size(); ++k) {
        train.left_V[k] = left[k].volts;
        train.leftAt_ns[k] = (left[k].at + offset).count();
    }
    map_.trains[next_ % kTrains].write(train);
    ++next_;
}

std::optional<UnitFault> UnitRecord::fault() const noexcept {
    const Fault& kept = map_.fault.content;
    if (kept.causes == 0) return std::nullopt;
    return UnitFault{static_cast<std::uint32_t>(kept.causes),
                     std::chrono::sys_seconds(std::chrono::seconds(kept.wall_s)), textIn(kept.reason)};
}

void UnitRecord::keepFault(FaultCause cause, std::string_view reason) noexcept {
    Fault newer = map_.fault.content;
    // The first reason is kept, as by the interlock; further causes add up.
    if (newer.causes == 0) {
        newer.wall_s = time_.wall().time_since_epoch().count();
        copyText(newer.reason, reason);
    }
    newer.causes |= 1U << static_cast<unsigned>(cause);
    map_.fault.write(newer);
}

void UnitRecord::clearFault() noexcept { map_.fault.write({}); }

std::filesystem::path unitFolder() {
    const char* data = std::getenv("XDG_DATA_HOME");
    if (data != nullptr && *data != '\0') return std::filesystem::path(data) / "tactoscope" / "units";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr ? home : ".") / ".local" / "share" / "tactoscope" / "units";
}

}  // namespace tacto
