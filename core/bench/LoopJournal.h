// LoopJournal.h - the records that the control loop writes into the session, one function for each kind of record.
//
// Without a recorder the journal writes nothing; callers need no null check.
//
// Thread-safety: one caller, the control loop. Never blocks; allocates only if the interlock changes its state.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/bench/Telemetry.h"
#include "core/bench/delivery/TrainPlanner.h"
#include "core/bench/delivery/TrainReport.h"
#include "core/bench/sensing/FingerInput.h"
#include "core/devices/Device.h"
#include "core/session/SessionRecorder.h"

namespace tacto {

/// Records a device's report on itself as the session event "device report", with the report's rows as fields.
/// Thread-safety: as SessionRecorder::event(). Never allocates.
void recordReport(SessionRecorder& recorder, Instant at, const DeviceReport& report, std::string_view text) noexcept;

class LoopJournal {
public:
    /// `recorder` may be null and outlives the journal. The recorder has one stream for roughness frames, one for each
    /// stream of the sensor, and one for the frames of its board if that encodes.
    LoopJournal(SessionRecorder* recorder, int frameStream, std::vector<int> sensorStreams,
                std::optional<int> boardStream = {})
        : recorder_(recorder),
          frameStream_(frameStream),
          sensorStreams_(std::move(sensorStreams)),
          boardStream_(boardStream) {}

    /// Returns how long the disk has stood still; 0 without a recorder.
    [[nodiscard]] std::chrono::nanoseconds standsStillFor() const noexcept;

    /// Writes the samples and frames of the finger's last update.
    void finger(const FingerInput& finger) noexcept;
    void sensorLost(Instant at, const DeviceReport& report) noexcept;
    void sensorStale(Instant at, double age_s) noexcept;
    void flag(Instant at, RoughnessFlag flag) noexcept;
    /// `why` is empty when nothing keeps its trains back any longer.
    void boardSilent(Instant at, std::string_view why) noexcept;
    /// A train of the board that is not played: too late, too early, or with a newer one or a silence after it.
    void boardTrainSkipped(Instant at, double late_s) noexcept;

    void drive(Instant at, const DriveCommand& command) noexcept;
    void interlock(Instant at, InterlockState state, std::string_view reason) noexcept;
    void refused(Instant at, std::string_view why) noexcept;
    void fault(Instant at, std::string_view reason) noexcept;
    void measuredBeyond(Instant at, const MeasuredOutput& measured, const char* unit) noexcept;
    /// `kind`, a literal, says what ended the operator's order.
    void orderEnded(Instant at, const char* kind, std::string_view why) noexcept;

    /// Notes what was planned from R and P, before the plan is handed over.
    void planned(const PlannedTrain& train, double roughness, double pressure) noexcept;
    void planned(const PlannedLevel& train) noexcept;  ///< a train that a presentation has planned
    void planned(const PlannedBurst& burst, double roughness, double pressure) noexcept;
    /// Writes one row for each train: the programmed values, the approval, and the values read back. `name`: a literal.
    void train(const TrainReport& report, const char* name) noexcept;
    void burst(const TrainReport& report, const char* name) noexcept;

private:
    void event(Instant at, const char* kind, std::initializer_list<RecordField> fields, std::string_view text) noexcept;
    void command(Instant at, const char* name, std::initializer_list<RecordField> fields,
                 std::string_view text = {}) noexcept;

    SessionRecorder* recorder_;
    int frameStream_;
    std::vector<int> sensorStreams_;
    std::optional<int> boardStream_;
};

}  // namespace tacto
