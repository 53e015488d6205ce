#include "core/safety/UnitRecord.h"

#include <algorithm>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <random>
#include <span>
#include <unistd.h>

#include "core/base/ProgramStart.h"
#include "core/safety/LockedFile.h"

namespace tacto {

namespace {

constexpr std::uint64_t kMagic = 0x32'74'69'6e'75'74'63'61;  // "actunit2"
constexpr double kLongestStretch = 2;                        // as in the gate: how much longer a window may last

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
    std::uint64_t trainSize = 0;  // differs if another build stored other trains
    std::array<char, 48> boot{};
    std::int64_t quietUntil_ns = 0;  // time since boot
    std::int64_t wall_s = 0;         // wall-clock time when it was opened
    std::int64_t process = 0;
    std::uint64_t id = 0;  // a random number for this record, stored in its claim
};

/// A booked train; times since boot.
struct Train {
    std::uint64_t sequence = 0;  // 0: no train is stored here
    std::int64_t earliest_ns = 0, latest_ns = 0, wall_s = 0;
    double hz = 0;
    std::array<TrainSums, 4> sums{};  // load range in 1 s and 5 s, then 500 ohm in 1 s and 5 s
    std::array<double, 2> left_V{};
    std::array<std::int64_t, 2> leftAt_ns{};
};

/// True if all bits are 0, as in a new file.
bool isEmpty(const Checked<Train>& train) {
    static const std::array<std::byte, sizeof train> kZeros{};
    const auto bytes = std::as_bytes(std::span(&train, 1));
    return std::memcmp(bytes.data(), kZeros.data(), bytes.size()) == 0;
}

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
    // The checksum separates units whose names differ only in characters that a file name cannot hold.
    return fmt::format("{}-{:08x}.unit", name.substr(0, 80), checksumOf(unit.data(), unit.size()) & 0xffffffff);
}

/// Returns the process that holds the record, if the record names it.
std::string holderOf(const std::filesystem::path& path) {
    Checked<Head> head;
    std::ifstream in(path, std::ios::binary);
    if (!in.read(reinterpret_cast<char*>(&head), sizeof head) || !head.sound()) return "another process";
    return programOf(head.content.process);
}

std::uint64_t newId() {
    std::random_device source;
    return static_cast<std::uint64_t>(source()) << 32U | source();
}

tl::unexpected<Error> refusalOf(const LockedFile::Refused& refused, const std::filesystem::path& path,
                                std::string_view unit) {
    switch (refused.why) {
        case LockedFile::Refusal::Held:
            return fail(ErrorCode::Device, "{} is driven by {}; end that first. Nothing was delivered here", unit,
                        holderOf(path));
        case LockedFile::Refusal::NotItsOwn:
            return fail(ErrorCode::Io,
                        "the record of what this unit has delivered, {}, is a link or a pipe, not a file of its own; "
                        "remove it. The unit is not driven without a record",
                        path.string());
        case LockedFile::Refusal::Failed:
            break;
    }
    return fail(ErrorCode::Io,
                "the record of what this unit has delivered, {}, cannot be kept: {}. Without it the unit is not driven",
                path.string(), std::strerror(refused.error));
}

}  // namespace

struct UnitRecord::Map {
    Checked<Head> head;
    Checked<Fault> fault;
    std::array<Checked<Train>, kTrains> trains;
};

Result<std::unique_ptr<UnitRecord>> UnitRecord::open(const UnitFolders& folders, std::string_view unit,
                                                     const Clock& clock, const SystemTime& time) {
    std::error_code failed;
    std::filesystem::create_directories(folders.records, failed);
    const auto path = folders.records / fileNameOf(unit);
    auto file = LockedFile::open(path, sizeof(Map), 0644);
    if (!file) return refusalOf(file.error(), path, unit);
    auto claim = UnitClaim::open(folders.claims, "tactoscope-" + fileNameOf(unit), unit);
    if (!claim) return failure(claim);
    return std::unique_ptr<UnitRecord>(new UnitRecord(std::move(*file), std::move(*claim), clock, time));
}

UnitRecord::UnitRecord(LockedFile&& file, std::unique_ptr<UnitClaim> claim, const Clock& clock, const SystemTime& time)
    : file_(std::move(file)),
      map_(*static_cast<Map*>(file_.content())),
      claim_(std::move(claim)),
      clock_(clock),
      time_(time),
      quietUntil_(clock.now()) {
    if (!file_.whole()) map_.head.sum = map_.fault.sum = 0;  // invalid: a missing record is not an empty one
    if (file_.made()) {
        map_.head.write({.trainSize = sizeof(Train)});
        map_.fault.write({});
    }
    takeOver();
}

UnitRecord::~UnitRecord() = default;

Instant UnitRecord::onClock(Instant sinceBoot) const noexcept { return clock_.now() + (sinceBoot - time_.sinceBoot()); }

/// Decides whether the content of the record is trusted, and takes the record over for this process.
void UnitRecord::takeOver() {
    const Instant boot = time_.sinceBoot();
    const auto wall = time_.wall().time_since_epoch().count();
    const std::string bootId = time_.boot();
    const Checked<Head> before = map_.head;
    std::string_view why;
    bool keep = false;  // true if the trains are from this start of the computer
    if (!before.sound() || before.content.magic != kMagic || before.content.trainSize != sizeof(Train)) {
        why = "its record is damaged or of another version";
    } else {
        auto newestWall = before.content.wall_s;
        auto newest = Instant(before.content.quietUntil_ns) - kRest;
        bool whole = true;
        std::uint64_t last = 0;
        for (const auto& train : map_.trains) {
            if (isEmpty(train)) continue;
            whole = whole && train.sound();
            last = std::max(last, train.content.sequence);
            newestWall = std::max(newestWall, train.content.wall_s);
            newest = std::max(newest, Instant(train.content.earliest_ns));
        }
        next_ = last + 1;
        keep = file_.made() || (!bootId.empty() && textIn(before.content.boot) == bootId);
        if (!whole) {
            why = "its record is incomplete, as when a program ends while it writes";
        } else if (keep && newest > boot) {
            why = "its record is from a time that has not come";
        } else if (!claim_) {
            why = "this computer has no place to note which record of it is the last one";
        } else if (!claim_->isOf(before.content.id)) {
            why = "a program drove it since from another record, of another account or data folder";
        } else if (!keep && !(wall - newestWall >= kLongAgo.count())) {
            why = "its record is from before the computer was started, and the wall clock does not say how long ago";
        }
    }
    // A new id each time: a copy of the record (from a backup, for example) is from now on a different record.
    Head head{.trainSize = sizeof(Train), .wall_s = wall, .process = ::getpid(), .id = newId()};
    copyText(head.boot, bootId);
    head.quietUntil_ns = !why.empty() ? (boot + kRest).count() : keep ? before.content.quietUntil_ns : 0;
    if (!why.empty() || !keep) {
        // The checksum stays wrong until the new head is written.
        std::atomic_ref(map_.head.sum).store(0);
        for (auto& train : map_.trains) train = {};
        next_ = 1;
    }
    const bool faultElsewhere = claim_ && claim_->faulted();
    if (!map_.fault.sound() || (faultElsewhere && map_.fault.content.causes == 0)) {
        // Treated as a fault of the device: a reset checks the device, and arming begins with a check pulse. Counts as
        // grave, since the cause is not known.
        Fault unknown{.causes = bitOf(FaultCause::DeviceFault) | bitOf(FaultCause::Internal), .wall_s = wall};
        copyText(unknown.reason,
                 map_.fault.sound()
                     ? "a program of another account or data folder left this unit in a fault"
                     : "the record of this unit is damaged; whether it was left in a fault is not known");
        map_.fault.write(unknown);
    }
    map_.head.write(head);
    if (const Fault& kept = map_.fault.content; kept.causes != 0)
        fault_ = UnitFault{static_cast<std::uint32_t>(kept.causes),
                           std::chrono::sys_seconds(std::chrono::seconds(kept.wall_s)), textIn(kept.reason)};
    // Done last: until then the claim names another record, so this one would not be trusted.
    if (claim_) claim_->take(head.id, fault_.has_value());
    if (Instant(head.quietUntil_ns) > boot) {
        why_ = why.empty() ? "a program before this one did not know it either" : why;
        quietUntil_ = onClock(Instant(head.quietUntil_ns));
    }
}

ResidualVoltages UnitRecord::replay(ExposureMeter& meter) const noexcept {
    const Instant boot = time_.sinceBoot();
    const Instant window = toInstant(ExposureMeter::kLongestWindow * kLongestStretch);
    ResidualVoltages left;
    if (next_ == 1) return left;
    // Read in the order of booking; overwritten trains are older than any window.
    const std::uint64_t oldest = next_ > kTrains ? next_ - kTrains : 1;
    for (std::uint64_t sequence = oldest; sequence < next_; ++sequence) {
        const Train& train = map_.trains[sequence % kTrains].content;
        if (train.sequence != sequence) continue;
        for (std::size_t k = 0; k < left.size(); ++k)
            left[k] = {train.left_V[k], onClock(Instant(train.leftAt_ns[k]))};  // the last one read is the newest
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
    // Computed each time, because the clock stands still while the computer sleeps.
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

void UnitRecord::keepFault(FaultCause cause, std::string_view reason) noexcept {
    // Keep the first reason, as the interlock does; add further causes.
    if (!fault_) fault_ = UnitFault{0, time_.wall(), FixedText<159>(reason)};
    fault_->causes |= bitOf(cause);
    writeFault();
}

void UnitRecord::clearFault() noexcept {
    fault_.reset();
    writeFault();
}

void UnitRecord::holdFault() noexcept {
    if (!held_) held_ = fault_;
}

void UnitRecord::writeFault() noexcept {
    Fault newer;
    for (const auto& each : {held_, fault_}) {
        if (!each) continue;
        if (newer.causes == 0) {
            newer.wall_s = each->at.time_since_epoch().count();
            copyText(newer.reason, each->reason.view());
        }
        newer.causes |= each->causes;
    }
    map_.fault.write(newer);
    if (claim_) claim_->keepFault(newer.causes != 0);
}

UnitFolders unitFolders() { return {dataFolder() / "units", "/run/lock"}; }

namespace {

constexpr std::uint64_t kClaimMagic = 0x31'6d'69'61'6c'63'74;  // "tclaim1"

struct Claim {
    std::uint64_t magic = kClaimMagic;
    std::uint64_t record = 0;
    std::uint64_t faulted = 0;
    std::int64_t process = 0;
};

}  // namespace

struct UnitClaim::State {
    explicit State(LockedFile&& opened) : file(std::move(opened)) {}
    [[nodiscard]] Checked<Claim>& claim() const noexcept { return *static_cast<Checked<Claim>*>(file.content()); }
    LockedFile file;
};

Result<std::unique_ptr<UnitClaim>> UnitClaim::open(const std::filesystem::path& folder, std::string_view file,
                                                   std::string_view unit) {
    const auto path = folder / file;
    auto opened = LockedFile::open(path, sizeof(Checked<Claim>), 0666);
    if (opened) return std::unique_ptr<UnitClaim>(new UnitClaim(std::make_unique<State>(std::move(*opened))));
    if (opened.error().why != LockedFile::Refusal::Held) return nullptr;
    Checked<Claim> claim;
    const int held = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    const bool known = held >= 0 && ::read(held, &claim, sizeof claim) == sizeof claim && claim.sound();
    if (held >= 0) ::close(held);
    return fail(ErrorCode::Device, "{} is driven by {}; end that first. Nothing was delivered here", unit,
                known ? programOf(claim.content.process) : "another process");
}

UnitClaim::UnitClaim(std::unique_ptr<State> state) : state_(std::move(state)) {}
UnitClaim::~UnitClaim() = default;

bool UnitClaim::isOf(std::uint64_t record) const noexcept {
    if (state_->file.made()) return true;
    const auto& claim = state_->claim();
    return claim.sound() && claim.content.magic == kClaimMagic && claim.content.record == record;
}

bool UnitClaim::faulted() const noexcept {
    if (state_->file.made()) return false;
    const auto& claim = state_->claim();
    return !claim.sound() || claim.content.magic != kClaimMagic || claim.content.faulted != 0;
}

void UnitClaim::take(std::uint64_t record, bool faulted) noexcept {
    state_->claim().write({.record = record, .faulted = faulted ? 1U : 0U, .process = ::getpid()});
}

void UnitClaim::keepFault(bool faulted) noexcept {
    auto newer = state_->claim().content;
    newer.faulted = faulted ? 1 : 0;
    state_->claim().write(newer);
}

}  // namespace tacto
