// The record of what a unit delivered, with any bytes changed or replaced: it opens, but unless it is unchanged,
// nothing in it is believed, the unit must rest, and a possible fault stays (hazards H1 and H2). The first byte chooses
// what the rest is: changes to an intact record, each with three bytes of position and one byte to XOR there; or the
// whole file.
#include <vector>

#include "core/base/Csv.h"
#include "core/safety/UnitRecord.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::UnitRecordFuzz {

namespace {

using namespace tacto;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* kUnit = "sciencemode 1234";
constexpr int kTrainsBooked = 3;

struct StandingTime final : SystemTime {
    [[nodiscard]] Instant sinceBoot() const noexcept override { return std::chrono::hours(1); }
    [[nodiscard]] std::string boot() const override { return "boot-1"; }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override {
        return std::chrono::sys_seconds(std::chrono::seconds(1'790'000'000));
    }
};

UnitFolders folders() { return {fuzz::scratchFolder() / "units", fuzz::scratchFolder() / "claims"}; }

std::filesystem::path onlyFileIn(const std::filesystem::path& folder) {
    return std::filesystem::directory_iterator(folder)->path();
}
Bytes contentOfFile(const std::filesystem::path& path) {
    const auto text = readTextFile(path).value();
    return {text.begin(), text.end()};
}
void write(const std::filesystem::path& path, const Bytes& bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    require(!!file.flush());
}

/// A record with trains and a fault, and the claim that this record is the latest.
struct Sound {
    Sound() {
        for (const auto& folder : {folders().records, folders().claims}) std::filesystem::create_directories(folder);
        const VirtualClock clock;
        const StandingTime time;
        {
            const auto opened = UnitRecord::open(folders(), kUnit, clock, time);
            require(opened.has_value());
            for (int i = 0; i < kTrainsBooked; ++i) {
                BookedTrain train;
                train.hz = 2;
                train.overRange.in5s.currentSquared_A2s = 1e-4;
                (*opened)->book(train, {});
            }
            (*opened)->keepFault(FaultCause::DeviceFault, "the device said so");
        }
        record = contentOfFile(onlyFileIn(folders().records));
        claim = contentOfFile(onlyFileIn(folders().claims));
    }
    Bytes record, claim;
};

}  // namespace

TACTO_FUZZ(UnitRecordFuzz, const std::uint8_t* data, std::size_t size) {
    static const Sound sound;
    if (size == 0) return 0;
    auto bytes = sound.record;
    if (data[0] % 2 == 0) {
        for (std::size_t i = 1; i + 3 < size; i += 4)
            bytes[(data[i] * 65536U + data[i + 1] * 256U + data[i + 2]) % bytes.size()] ^= data[i + 3];
    } else {
        bytes.assign(data + 1, data + size);
    }
    write(onlyFileIn(folders().records), bytes);
    write(onlyFileIn(folders().claims), sound.claim);

    const VirtualClock clock;
    const StandingTime time;
    const auto opened = UnitRecord::open(folders(), kUnit, clock, time);
    require(opened.has_value());
    ExposureMeter meter;
    static_cast<void>((*opened)->replay(meter));
    require((*opened)->fault().has_value());
    if (bytes == sound.record) {
        require((*opened)->whyQuiet().empty() && meter.size() == kTrainsBooked);
        require((*opened)->fault()->reason.view() == "the device said so");
    } else if ((*opened)->whyQuiet().empty()) {
        // Only the record of the fault was changed; then the fault is treated as damaged.
        require(meter.size() == kTrainsBooked);
        require((*opened)->fault()->reason.view().find("damaged") != std::string_view::npos);
    } else {
        require(meter.size() == 0 && (*opened)->quietUntil() >= clock.now() + UnitRecord::kRest);
    }
    return 0;
}

}  // namespace tacto::fuzz::UnitRecordFuzz
