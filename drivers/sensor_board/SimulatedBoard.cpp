#include "drivers/sensor_board/SimulatedBoard.h"

#include <algorithm>

#include "core/base/Csv.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto::sensorboard {

namespace {
constexpr std::string_view kKeys[] = {"encodes", "drift", "profile"};
constexpr double kMaxDrift_ppm = 50'000;
constexpr std::size_t kMaxProfile = 10'000;  // bytes
}  // namespace

bool SimulatedBoard::isOwn(std::string_view key) noexcept { return std::ranges::find(kKeys, key) != std::end(kKeys); }

SimulatedBoard::SimulatedBoard(DeviceIdentity identity, std::shared_ptr<FirmwareBoard> board, Encodes encodes,
                               const Clock& clock)
    : identity_(std::move(identity)), board_(std::move(board)), encodes_(encodes), clock_(clock) {
    settings_->uri = identity_.uri;
    settings_->emulated = true;
}

Result<std::unique_ptr<TactileSensor>> SimulatedBoard::open(std::unique_ptr<TactileSensor> finger, const DeviceUri& uri,
                                                            const Clock& clock) {
    UriParameters from(uri);
    const auto word = from.choice("encodes", "drives", {"no", "shown", "drives"});
    const auto encodes = word == "drives" ? Encodes::Drives : word == "shown" ? Encodes::Shown : Encodes::No;
    const double drift_ppm = from.quantity("drift", "ppm", 0, -kMaxDrift_ppm, kMaxDrift_ppm);
    const auto file = from.text("profile");
    if (auto read = from.finish(); !read) return failure(read);
    auto identity = finger->identity();
    identity.uri = uri.text();
    identity.name = "simulated sensor board";
    auto machine = FirmwareBoard::make(std::move(finger), std::string(kEmulatedSerial) + identity.serial,
                                       identity.firmware, clock, drift_ppm);
    if (!machine) return uri.refuse(machine.error());
    std::unique_ptr<SimulatedBoard> board(new SimulatedBoard(std::move(identity), std::move(*machine), encodes, clock));
    std::string profile;
    if (file) {
        auto bytes = readTextFile(*file, kMaxProfile);
        if (!bytes) return failure(bytes);
        profile = std::move(*bytes);
        board->hasOwnProfile_ = true;
    }
    if (auto begun = board->begin(profile, true); !begun) return uri.refuse(begun.error());
    return board;
}

Result<void> SimulatedBoard::load(std::string_view profile, bool rested) {
    auto begun = begin(profile, rested);
    if (!begun) static_cast<void>(begin(profile_, rested));
    return begun;
}

Result<void> SimulatedBoard::begin(std::string_view bytes, bool rested) {
    te_profile read{};
    if (!bytes.empty()) {
        const auto refusal = te_read_profile(&read, reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                             static_cast<std::uint32_t>(bytes.size()));
        if (refusal != TE_ACCEPTED) return invalid("the profile for its encoder has {}", wordsOf(refusal));
    }
    const auto* profile = bytes.empty() ? nullptr : &read;
    if (plugged_) {
        if (auto begun = plugged_->rewrite([&] { restart(profile, rested); }); !begun) return begun;
    } else {
        restart(profile, rested);
        const auto connect = [board = board_, settings = settings_, &clock = clock_](const std::string&) {
            return SensorBoard::open(board->line(), *settings, clock);
        };
        auto opened = connect({});
        if (!opened) return failure(opened);
        plugged_ = std::make_unique<PluggedBoard>(std::move(*opened), connect);
    }
    profile_ = bytes;
    return {};
}

void SimulatedBoard::restart(const te_profile* profile, bool rested) {
    board_->restart(profile, rested);
    settings_->encodes = profile != nullptr ? encodes_ : Encodes::No;
}

}  // namespace tacto::sensorboard
