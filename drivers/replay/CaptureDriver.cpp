#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/ranges.h>
#include <limits>
#include <system_error>

#include "core/devices/Device.h"
#include "core/devices/ScopeRange.h"
#include "core/measure/CaptureDescription.h"
#include "drivers/replay/ReplayDrivers.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr ScopeTraits kTraits{Hertz(1e9), 100'000'000, 32, Hertz(0)};

/// Plays the captures of a folder one after the other. Arming makes the next file begin now; later files keep their
/// distance in time, so that intervals stay as recorded and no file takes longer than it did. Settings are checked as
/// on an instrument, but do not change the recorded data.
class ReplayedCaptures final : public Oscilloscope, public ReplayedDevice {
public:
    ReplayedCaptures(std::vector<Capture> captures, DeviceIdentity identity, StatedOrigin origin, const Clock& clock)
        : captures_(std::move(captures)), identity_(std::move(identity)), origin_(origin), clock_(clock) {}

    const DeviceIdentity& identity() const noexcept override { return identity_; }
    StatedOrigin statedOrigin() const noexcept override { return origin_; }
    const ScopeTraits& traits() const noexcept override { return kTraits; }

    Result<void> configure(const ScopeSettings& s) override {
        if (auto checked = checkScopeRange(s, kTraits); !checked) return checked;
        settings_ = s;
        return {};
    }

    Result<void> arm() override {
        armed_ = true;
        if (next_ < captures_.size()) shift_s_ = toSeconds(clock_.now()) - captures_[next_].start_s;
        return {};
    }
    void disarm() noexcept override { armed_ = false; }

    Result<std::optional<Capture>> poll() override {
        if (!armed_ || next_ == captures_.size()) return std::optional<Capture>{};
        Capture& next = captures_[next_];
        const double start_s = next.start_s + shift_s_;
        const double end_s = start_s + static_cast<double>(next.samples()) / next.rate_hz;
        if (end_s > toSeconds(clock_.now())) return std::optional<Capture>{};
        ++next_;
        next.start_s = start_s;
        next.trigger_s = triggerOf(next, settings_);
        return std::optional<Capture>(std::move(next));
    }

private:
    /// Returns when |signal| first rises through the level; NaN if it never does.
    static double triggerOf(const Capture& capture, const ScopeSettings& settings) {
        const std::string_view unit = settings.triggerOnCurrent ? "A" : "V";
        const auto channel = std::ranges::find(capture.channels, unit, &CaptureChannel::unit);
        if (channel == capture.channels.end()) return std::numeric_limits<double>::quiet_NaN();
        const double level = settings.triggerLevel;
        for (std::size_t i = 1; i < channel->samples.size(); ++i) {
            const auto before = std::abs(static_cast<double>(channel->samples[i - 1]));
            const auto after = std::abs(static_cast<double>(channel->samples[i]));
            if (before < level && after >= level) return capture.start_s + static_cast<double>(i) / capture.rate_hz;
        }
        return std::numeric_limits<double>::quiet_NaN();
    }

    std::vector<Capture> captures_;  ///< captures before next_ were already returned
    const DeviceIdentity identity_;
    const StatedOrigin origin_;
    const Clock& clock_;
    double shift_s_ = 0;  ///< offset from a file's time to session time
    ScopeSettings settings_;
    std::size_t next_ = 0;
    bool armed_ = false;
};

class CaptureDriver final : public Driver {
public:
    explicit CaptureDriver(std::shared_ptr<const CaptureFormats> formats) : formats_(std::move(formats)) {}

    std::string_view scheme() const noexcept override { return "capture"; }
    bool runsOnVirtualClock() const noexcept override { return true; }
    std::vector<DeviceIdentity> list() const override {
        return {{"capture:FOLDER", Role::Oscilloscope, "an oscilloscope from a folder of captures", "", "", false, "",
                 true}};
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (auto free = into.checkFree(Role::Oscilloscope, uri); !free) return free;
        if (!uri.parameters.empty()) {
            return uri.refuse(ErrorCode::InvalidArgument, "parameter {} is not known; capture: takes none",
                              uri.parameters.front().first);
        }
        std::error_code error;
        if (!fs::is_directory(uri.path, error)) {
            return uri.refuse(ErrorCode::NotFound, "{} is not a folder; one with captures ({}) was expected",
                              uri.path.empty() ? "\"\"" : uri.path, fmt::join(formats_->suffixes(), ", "));
        }
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(uri.path, error)) {
            if (entry.is_regular_file(error) && formats_->knowsSuffix(entry.path())) files.push_back(entry.path());
        }
        std::ranges::sort(files);
        if (files.empty()) {
            return uri.refuse(ErrorCode::NotFound, "{} holds no capture; files {} were expected", uri.path,
                              fmt::join(formats_->suffixes(), ", "));
        }
        // One simulated capture makes the instrument simulated; one without a statement leaves its origin unknown.
        std::optional<bool> simulated = false;
        for (const auto& file : files) {
            const auto stated = statedSimulated(file);
            if (simulated != true) simulated = stated == false ? simulated : stated;
        }
        std::vector<Capture> captures;
        for (const auto& file : files) {
            auto reading = formats_->read(file);
            if (!reading) return failure(reading);
            reading->capture.warnings = std::move(reading->warnings);
            reading->capture.simulated = simulated.value_or(false);
            captures.push_back(std::move(reading->capture));
        }
        DeviceIdentity identity{
            uri.text(), Role::Oscilloscope,       fmt::format("{} captures from {}", captures.size(), uri.path), "",
            "",         simulated.value_or(false)};
        const auto origin = !simulated   ? StatedOrigin::NotStated
                            : *simulated ? StatedOrigin::Simulated
                                         : StatedOrigin::Measured;
        into.oscilloscope =
            std::make_unique<ReplayedCaptures>(std::move(captures), std::move(identity), origin, context.clock);
        return {};
    }

private:
    std::shared_ptr<const CaptureFormats> formats_;
};

}  // namespace

std::unique_ptr<Driver> makeCaptureDriver(std::shared_ptr<const CaptureFormats> formats) {
    return std::make_unique<CaptureDriver>(std::move(formats));
}

}  // namespace tacto
