#include "app/scripting/engine/RunReadings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace tacto {

namespace {

void makePlain(nlohmann::json& value) {
    constexpr double kExact = 9007199254740992.0;
    if (value.is_structured()) std::for_each(value.begin(), value.end(), makePlain);
    if (!value.is_number_float()) return;
    const double x = value.get<double>();
    if (!std::isfinite(x)) value = nullptr;
    if (std::abs(x) < kExact && x == std::floor(x)) value = static_cast<std::int64_t>(x);
}

}  // namespace

nlohmann::json asScriptsSeeIt(nlohmann::json value) {
    makePlain(value);
    return value;
}

std::int64_t RunReadings::add(OwnReading reading) {
    readings_.push_back(std::move(reading));
    return static_cast<std::int64_t>(readings_.size());
}

std::int64_t RunReadings::add(OwnCalibration calibration) {
    calibrations_.push_back(std::move(calibration));
    return static_cast<std::int64_t>(calibrations_.size());
}

Result<std::vector<const OwnReading*>> RunReadings::readings(const std::vector<std::int64_t>& numbers) const {
    std::vector<const OwnReading*> found;
    std::set<std::int64_t> seen, captures;
    for (const auto number : numbers) {
        if (number < 1 || static_cast<std::size_t>(number) > readings_.size()) {
            return fail(ErrorCode::InvalidArgument,
                        "there is no reading {} in this run; the number that measure.pulse() gave is expected", number);
        }
        const auto& reading = readings_[static_cast<std::size_t>(number) - 1];
        bool again = !seen.insert(number).second;
        for (const auto capture : reading.captures) again = !captures.insert(capture).second || again;
        if (again) {
            return fail(ErrorCode::InvalidArgument,
                        "reading {} was given before, or shares a capture with one that was; a reading counts once",
                        number);
        }
        found.push_back(&reading);
    }
    return found;
}

void RunReadings::note(nlohmann::json made) { made_.push_back(asScriptsSeeIt(std::move(made))); }

bool RunReadings::noted(const nlohmann::json& said) const {
    return std::find(made_.begin(), made_.end(), said) != made_.end();
}

const OwnCalibration* RunReadings::calibration(const nlohmann::json& number) const noexcept {
    if (!number.is_number_integer()) return nullptr;
    const auto index = number.get<std::int64_t>();
    if (index < 1 || static_cast<std::size_t>(index) > calibrations_.size()) return nullptr;
    return &calibrations_[static_cast<std::size_t>(index) - 1];
}

const OwnQuantity* ownQuantity(std::string_view id) noexcept {
    static constexpr std::array<OwnQuantity, 4> kQuantities{{{kCalibratedAmplitude, &CapturedCommand::amplitude},
                                                             {kCalibratedInterval, &CapturedCommand::interval_s},
                                                             {kCalibratedWidth, &CapturedCommand::width_s},
                                                             {kCalibratedGap, &CapturedCommand::gap_s}}};
    for (const auto& quantity : kQuantities) {
        if (quantity.id == id) return &quantity;
    }
    return nullptr;
}

}  // namespace tacto
