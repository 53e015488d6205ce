#include "core/bench/LoopJournal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

/// Returns the shape in words. All texts are literals, because the loop must not allocate.
std::string_view shapeText(const PulseTrain& train) noexcept {
    const bool positive = train.polarity == Polarity::Positive;
    switch (train.shape) {
        case PulseShape::SymmetricBiphasic:
            return positive ? "symmetric biphasic, positive phase first" : "symmetric biphasic, negative phase first";
        case PulseShape::AsymmetricBiphasic:
            return positive ? "asymmetric biphasic, positive phase first" : "asymmetric biphasic, negative phase first";
        case PulseShape::Monophasic:
            return positive ? "monophasic, positive" : "monophasic, negative";
    }
    return {};
}

}  // namespace

static_assert(DeviceReport::kMaxRows <= SessionRecorder::kMaxFields);

void recordReport(SessionRecorder& recorder, Instant at, const DeviceReport& report, std::string_view text) noexcept {
    std::array<RecordField, DeviceReport::kMaxRows> fields{};
    std::size_t count = 0;
    for (const auto& row : report.rows()) fields[count++] = {row.key, row.value};
    recorder.event(at, "device report", std::span<const RecordField>(fields.data(), count), text);
}

void LoopJournal::event(Instant at, const char* kind, std::initializer_list<RecordField> fields,
                        std::string_view text) noexcept {
    if (recorder_ != nullptr) recorder_->event(at, kind, fields, text);
}

void LoopJournal::command(Instant at, const char* name, std::initializer_list<RecordField> fields,
                          std::string_view text) noexcept {
    if (recorder_ != nullptr) recorder_->command(at, name, fields, text);
}

std::chrono::nanoseconds LoopJournal::standsStillFor() const noexcept {
    return recorder_ != nullptr ? recorder_->standsStillFor() : std::chrono::nanoseconds(0);
}

namespace {
/// The columns of both encoders' streams, in order (BenchState.cpp).
template <class Frame>
std::array<double, 7> columnsOf(const Frame& frame) noexcept {
    return {
        frame.contact ? 1.0 : 0.0, frame.sliding ? 1.0 : 0.0, frame.h, frame.v, frame.R, frame.pressure_pa, frame.P};
}
}  // namespace

void LoopJournal::finger(const FingerInput& finger) noexcept {
    if (recorder_ == nullptr) return;
    const auto blocks = finger.blocks();
    const auto streams = finger.session().device().streams();
    for (std::size_t s = 0; s < blocks.size(); ++s) {
        if (blocks[s].samples() > 0) recorder_->samples(sensorStreams_[s], streams[s].channels, blocks[s]);
    }
    for (const auto& frame : finger.frames()) recorder_->frame(frameStream_, frame.t_s, columnsOf(frame));
    if (!boardStream_) return;
    for (const auto& frame : finger.encoded().frames) recorder_->frame(*boardStream_, frame.t_s, columnsOf(frame));
}

void LoopJournal::sensorLost(Instant at, const DeviceReport& report) noexcept {
    if (recorder_ == nullptr) return;
    recordReport(*recorder_, at, report, "something was lost between the fingertip sensor and this program");
}

void LoopJournal::sensorStale(Instant at, double age_s) noexcept {
    event(at, "stale", {{"age_s", age_s}}, "sensor data are older than 100 ms: no new trains");
}

void LoopJournal::flag(Instant at, RoughnessFlag flag) noexcept { event(at, kMarkEvent, {}, nameOf(flag)); }

void LoopJournal::boardSilent(Instant at, std::string_view why) noexcept {
    event(at, "board silent", {}, why.empty() ? "nothing keeps the board's trains back" : why);
}

void LoopJournal::boardTrainSkipped(Instant at, double late_s) noexcept {
    event(at, "board train skipped", {{"late_s", late_s}},
          "a train of the board was not played: late, early, or overtaken by a newer one or by its silence");
}

void LoopJournal::drive(Instant at, const DriveCommand& drive) noexcept {
    command(at, "drive", {{"roughness", drive.roughness}, {"pressure", drive.pressure}},
            drive.source == DriveSource::Manual   ? "manual"
            : drive.source == DriveSource::Sensor ? "sensor"
                                                  : "off");
}

void LoopJournal::interlock(Instant at, InterlockState state, std::string_view reason) noexcept {
    if (recorder_ == nullptr) return;
    event(at, "interlock", {}, fmt::format("{}{}{}", nameOf(state), reason.empty() ? "" : ": ", reason));
}

void LoopJournal::refused(Instant at, std::string_view why) noexcept { event(at, "refused", {}, why); }
void LoopJournal::fault(Instant at, std::string_view reason) noexcept { event(at, "fault", {}, reason); }
void LoopJournal::orderEnded(Instant at, const char* kind, std::string_view why) noexcept { event(at, kind, {}, why); }

void LoopJournal::measuredBeyond(Instant at, const MeasuredOutput& measured, const char* unit) noexcept {
    std::array<char, 160> text{};
    fmt::format_to_n(text.data(), text.size() - 1,
                     "Measured beyond the stimulator's accuracy: {} {:.4g} {} where {:.4g} {} was set.", measured.by,
                     measured.amplitude, unit, measured.set, unit);
    event(at, kMeasuredBeyondEvent,
          {{"measured", measured.amplitude}, {"uncertainty", measured.uncertainty}, {"set", measured.set}},
          text.data());
}

namespace {
/// "rms_current_5s of paper"; empty if no limit judged the train.
FixedText<80> textOf(const NearestLimit& nearest) noexcept {
    if (std::isnan(nearest.share)) return {};
    std::array<char, 80> text{};
    fmt::format_to_n(text.data(), text.size() - 1, "{} of {}", keyOf(nearest.quantity), nearest.set.view());
    return std::string_view(text.data());
}
}  // namespace

void LoopJournal::planned(const PlannedTrain& train, double roughness, double pressure) noexcept {
    command(train.onset, "train",
            {{"amplitude_v", train.command.amplitude.value()},
             {"held_v", train.held.value()},
             {"interval_s", train.command.interval.count()},
             {"roughness", roughness},
             {"pressure", pressure},
             {"amplitude", siValue(train.rounding.train.amplitude)},
             {"rounded_by", train.rounding.amplitude},
             {"limit_share", train.approved.nearest().share}},
            textOf(train.approved.nearest()).view());
}

void LoopJournal::planned(const PlannedLevel& train) noexcept {
    command(train.onset, "train",
            {{"interval_s", train.approved.interval().count()},
             {"amplitude", siValue(train.approved.train().amplitude)},
             {"expected_ma", train.expected},
             {"limit_share", train.approved.nearest().share}},
            textOf(train.approved.nearest()).view());
}

void LoopJournal::planned(const PlannedBurst& burst, double roughness, double pressure) noexcept {
    command(burst.onset, "burst",
            {{"amplitude_v", burst.command.amplitude.value()},
             {"interval_s", burst.command.interval.count()},
             {"roughness", roughness},
             {"pressure", pressure},
             {"intensity", burst.approved.burst().intensity}});
}

void LoopJournal::train(const TrainReport& report, const char* name) noexcept {
    const auto& train = report.train;
    command(report.onset, name,
            {{"is_check", report.isCheck ? 1.0 : 0.0},
             {isCurrent(train.amplitude) ? "amplitude_ma" : "amplitude_v", report.amplitude},
             {"measured", report.measured},
             {"pulses", static_cast<double>(train.pulses)},
             {"rate_hz", train.rate.value()},
             {"width_s", Seconds(train.phaseWidth).count()},
             {"gap_s", Seconds(train.interPhaseGap).count()},
             {"recharge_ratio", train.shape == PulseShape::AsymmetricBiphasic ? train.rechargeRatio : NAN},
             {"interval_s", report.interval_s},
             {"approved_until_s", toSeconds(report.approvedUntil)},
             {"impedance_ohm", report.impedance_ohm},
             {"imbalance", report.imbalance}},
            report.error.empty() ? shapeText(train) : report.error.view());
}

void LoopJournal::burst(const TrainReport& report, const char* name) noexcept {
    command(report.onset, name,
            {{"intensity", report.amplitude},
             {"duration_s", toSeconds(std::max(Instant(0), report.end - report.onset))},
             {"interval_s", report.interval_s}},
            report.error.view());
}

}  // namespace tacto
