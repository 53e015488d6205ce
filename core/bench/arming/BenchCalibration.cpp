#include "core/bench/arming/BenchCalibration.h"

#include <fmt/chrono.h>

namespace tacto {

bool BenchCalibration::apply(bool wanted) {
    const auto next = wanted && config_.calibrationHolds ? config_.calibration : std::nullopt;
    if (next == applied_) return false;
    applied_ = next;
    return true;
}

Result<void> BenchCalibration::checkDate() const {
    if (config_.mode != OutputMode::Person || !config_.calibratedUntil) return {};
    const auto today = config_.today != nullptr
                           ? config_.today()
                           : std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    if (today <= *config_.calibratedUntil) return {};
    return fail(ErrorCode::NotArmed,
                "the stimulator's calibration ended on {:%Y-%m-%d} and today is {:%Y-%m-%d}; calibrate it again before "
                "a person",
                *config_.calibratedUntil, today);
}

void BenchCalibration::note(const BenchNotes& notes) const {
    const bool leftAside = held() && !applied_ && !config_.calibrationText.empty();
    notes.calibration(applied_,
                      leftAside ? "left aside: the commands are programmed as they are" : config_.calibrationText);
}

}  // namespace tacto
