#include "core/bench/delivery/TrainDispatch.h"

#include <cmath>
#include <utility>
#include <variant>

namespace tacto {

bool TrainDispatch::mayPost(bool isCheck) const noexcept {
    if (parts_.order.stopped()) return false;
    const auto state = parts_.interlock.state();
    if (isCheck && parts_.arming.active()) return state == InterlockState::Checking;
    return (state == InterlockState::Armed || state == InterlockState::Delivering) && !paused();
}

bool TrainDispatch::idle() const noexcept {
    return (parts_.stimulator == nullptr || parts_.stimulator->idle()) &&
           (parts_.massager == nullptr || parts_.massager->idle());
}

void TrainDispatch::forceOff() noexcept {
    if (parts_.stimulator != nullptr) parts_.stimulator->forceOff();
    if (parts_.massager != nullptr) parts_.massager->forceOff();
}

bool TrainDispatch::isDue(const TrainPlanner& planner, Instant now, Instant ahead) const noexcept {
    if ((parts_.stimulator == nullptr && parts_.massager == nullptr) || !idle()) return false;
    const auto due = planner.due();
    return due && *due < now + ahead && mayPost(false);
}

bool TrainDispatch::beginDelivery() noexcept {
    if (parts_.interlock.state() == InterlockState::Armed) {
        if (const auto begun = parts_.interlock.beginDelivery(); !begun) return false;
        began_ = true;
    }
    return mayPost(false);
}

Result<void> TrainDispatch::sendTrain(TrainPlanner& planner, Instant now, StepTelemetry& shown) {
    planner.armedOn(parts_.load.reference);
    auto planned = planner.plan(now, parts_.load.impedance);
    if (!planned) return failure(planned);
    if (!beginDelivery()) return {};
    const bool board = shown.boardDrives && shown.driving == DriveSource::Sensor;
    parts_.journal.planned(*planned, board ? shown.boardRoughness : shown.roughness,
                           board ? shown.boardPressure : shown.pressure);
    parts_.judge.expect(planned->expected);
    post(std::move(planned->approved), planned->onset, planned->expected, shown);
    return {};
}

Result<void> TrainDispatch::sendBurst(TrainPlanner& planner, Instant now, const StepTelemetry& shown) {
    auto planned = planner.planBurst(now);
    if (!planned) return failure(planned);
    if (!beginDelivery()) return {};
    parts_.journal.planned(*planned, shown.roughness, shown.pressure);
    parts_.massager->post(std::move(planned->approved), planned->onset, planned->command.interval);
    return {};
}

Result<void> TrainDispatch::sendPresented(PresentationRun& presentation, TrainPlanner& planner, Instant now,
                                          StepTelemetry& shown) {
    auto planned = presentation.plan(planner, parts_.gate, now);
    if (!planned) return failure(planned);
    if (!mayPost(false)) return {};
    presentation.posted();
    if (auto* burst = std::get_if<PlannedVibration>(&*planned)) {
        parts_.massager->post(std::move(burst->approved), burst->onset, burst->interval);
        return {};
    }
    auto& train = std::get<PlannedLevel>(*planned);
    parts_.journal.planned(train);
    parts_.judge.expect(train.expected);
    post(std::move(train.approved), train.onset, train.expected, shown);
    return {};
}

Result<void> TrainDispatch::sendCheck(Instant now, StepTelemetry& shown) {
    auto check = parts_.gate.approveCheck(now);
    if (!check) return failure(check);
    if (mayPost(true)) postCheck(std::move(*check), now, shown);
    return {};
}

void TrainDispatch::post(ApprovedTrain&& train, Instant onset, std::optional<double> expected,
                         StepTelemetry& shown) noexcept {
    const auto& amplitude = train.train().amplitude;
    const double programmed = siValue(amplitude) * (isCurrent(amplitude) ? 1e3 : 1);
    // Count check pulses too, so that a capture of one is not assigned to a train delivered shortly before.
    ++posted_;
    lastPosted(shown) = {
        onset,    programmed, expected.value_or(programmed), onset, StimulatorSession::latestEnd(train.train(), onset),
        !expected};
    parts_.latest.write(shown);
    parts_.stimulator->post(std::move(train), onset, !expected);
    parts_.exposure.lookNext();
}

void TrainDispatch::reported(const TrainReport& report, StepTelemetry& shown) const noexcept {
    if (posted_ == 0) return;
    auto& train = lastPosted(shown);
    if (report.outcome == TrainOutcome::Voided) train.amplitude = NAN;
    if (report.end == Instant(0)) return;  // no better time of output is known
    train.from = report.onset;
    train.until = report.end;
    train.acknowledged = report.outcome == TrainOutcome::Delivered;
}

}  // namespace tacto
