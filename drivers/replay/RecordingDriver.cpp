#include <algorithm>
#include <cmath>
#include <limits>

#include "core/devices/Device.h"
#include "core/devices/DeviceUri.h"
#include "core/exchange/recordings/OpenRecording.h"
#include "drivers/replay/ReplayDrivers.h"

namespace tacto {

namespace {

constexpr double kSlowest = 0.01;
constexpr double kFastest = 100;

class ReplayedRecording final : public TactileSensor, public ReplayedDevice {
public:
    ReplayedRecording(Recording recording, DeviceIdentity identity, double speed, const Clock& clock)
        : recording_(std::move(recording)),
          identity_(std::move(identity)),
          clock_(clock),
          speed_(speed),
          origin_s_(recording_.extent().begin_s),
          opened_s_(toSeconds(clock.now())),
          infos_(recording_.infos()),
          next_(infos_.size()) {
        for (auto& info : infos_) info.rate_hz *= speed_;
    }

    const DeviceIdentity& identity() const noexcept override { return identity_; }
    StatedOrigin statedOrigin() const noexcept override {
        if (!recording_.simulated) return StatedOrigin::NotStated;
        return *recording_.simulated ? StatedOrigin::Simulated : StatedOrigin::Measured;
    }
    std::span<const StreamInfo> streams() const noexcept override { return infos_; }

    Result<void> read(std::span<SampleBlock> blocks) override {
        if (blocks.size() != infos_.size()) {
            return fail(ErrorCode::InvalidArgument, "recording: {} blocks were given for {} streams", blocks.size(),
                        infos_.size());
        }
        const double now = toSeconds(clock_.now());
        for (std::size_t s = 0; s < infos_.size(); ++s) {
            const auto& samples = recording_.streams[s].samples;
            const std::size_t channels = infos_[s].channels;
            // Keeps the recorded order: a sample with an earlier stamp is returned together with the sample before it.
            for (auto& i = next_[s]; i < samples.samples() && sessionTime(samples.t_s[i]) <= now; ++i) {
                blocks[s].t_s.push_back(sessionTime(samples.t_s[i]));
                const auto* row = samples.values.data() + i * channels;
                blocks[s].values.insert(blocks[s].values.end(), row, row + channels);
            }
        }
        return {};
    }

    DeclaredIntervals declared() const override {
        auto declared = recording_.declared;
        const auto moved = [&](TimeInterval& t) { t = {sessionTime(t.begin_s), sessionTime(t.end_s)}; };
        if (declared.baseline) moved(*declared.baseline);
        if (declared.contact) std::ranges::for_each(*declared.contact, moved);
        return declared;
    }

    bool finished() const noexcept override {
        for (std::size_t s = 0; s < next_.size(); ++s) {
            if (next_[s] < recording_.streams[s].samples.samples()) return false;
        }
        return true;
    }

private:
    [[nodiscard]] double sessionTime(double recorded_s) const noexcept {
        return opened_s_ + (recorded_s - origin_s_) / speed_;
    }

    const Recording recording_;
    const DeviceIdentity identity_;
    const Clock& clock_;
    const double speed_;
    const double origin_s_;  // the recording's first time stamp
    const double opened_s_;
    std::vector<StreamInfo> infos_;
    std::vector<std::size_t> next_;  // for each stream the first sample not read yet
};

class RecordingDriver final : public Driver {
public:
    std::string_view scheme() const noexcept override { return "recording"; }
    bool runsOnVirtualClock() const noexcept override { return true; }
    std::vector<DeviceIdentity> list() const override {
        return {{"recording:FOLDER", Role::Sensor, "a recording replayed as a fingertip", "", "", false, "", true}};
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (auto free = into.checkFree(Role::Sensor, uri); !free) return free;
        if (uri.path.empty()) {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\" names no recording: write recording:FOLDER, recording:FILE.json, or an EDF, BDF "
                        "or XDF file",
                        uri.text());
        }
        UriParameters from(uri);
        const double speed = from.quantity("speed", "", 1, kSlowest, kFastest);
        if (auto read = from.finish(); !read) return read;
        auto recording = openRecording(uri.path);
        if (!recording) return failure(recording);
        auto name = "recording: " + recording->title;
        if (!recording->warnings.empty()) name += " (" + recording->warnings.front() + ")";
        DeviceIdentity identity{uri.text(),           Role::Sensor, std::move(name),
                                recording->fingertip, "",           recording->simulated.value_or(false)};
        into.sensor =
            std::make_unique<ReplayedRecording>(std::move(*recording), std::move(identity), speed, context.clock);
        return {};
    }
};

}  // namespace

std::unique_ptr<Driver> makeRecordingDriver() { return std::make_unique<RecordingDriver>(); }

}  // namespace tacto
