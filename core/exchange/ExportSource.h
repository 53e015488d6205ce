// ExportSource.h - a session as every export reads it: verified first, never changed, and read piece by piece.
//
// A session that ended without closing is read as far as it goes and marked. Of a damaged one that is read which can
// be: samples that cannot are a gap, rows that cannot are left out, and everything is marked.
//
// Times are seconds since the session's start. NaN and an empty text mean absent.
//
// Thread-safety: one caller at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Stream.h"
#include "core/exchange/ExportWatch.h"
#include "core/measure/Capture.h"
#include "core/results/ResultTable.h"
#include "core/session/RowSeal.h"
#include "core/session/SessionTypes.h"

namespace tacto {

struct ExportChannel {
    std::string name;          ///< "acceleration_x", "R": the same in every format
    std::string unit;          ///< the session's: "m/s2", "N", "Pa", "count"; "1" where there is none
    std::uint64_t absent = 0;  ///< number of samples that are NaN
    std::uint64_t infinite = 0;
    bool whole = true;    ///< whether all finite values are whole numbers
    double least = kNaN;  ///< of the finite values; NaN without any
    double most = kNaN;
};

struct ExportStream {
    int id = 0;        ///< of the session
    std::string name;  ///< the kind, "acceleration"; the second of a kind is "acceleration-2"
    std::string kind;
    std::string title;  ///< the name for people: "fingertip accelerometer"
    std::vector<ExportChannel> channels;
    std::uint64_t samples = 0;
    double first_s = kNaN, last_s = kNaN;
    double declaredRate_hz = 0;     ///< 0: none
    double measuredRate_hz = kNaN;  ///< science.md section 1; NaN before two samples
    double rate_hz = kNaN;          ///< the declared one if the measured one is within 0.1 %, else the measured one
    bool regular = true;            ///< whether every step is within half a usual step of it
    bool rising = true;             ///< whether every stamp is later than the one before
    std::uint64_t gapCount = 0;
    std::vector<TimeInterval> gaps;  ///< from the last stamp before to the first after; the first kMaxGaps of them
    std::uint64_t lost = 0;          ///< samples that damage made unreadable, as far as is known
    bool simulated = false;

    static constexpr std::size_t kMaxGaps = 100'000;
    /// The position of the channel R of roughness frames, or nothing.
    [[nodiscard]] std::optional<std::size_t> channelR() const noexcept;
};

struct ExportCapture {
    std::string name;  ///< as `run` names its file: "trial-0001-00002"
    std::int64_t seq = 0;
    std::optional<int> trial;
    double at_s = 0;  ///< when it was recorded
    bool simulated = false;
    std::uint64_t samples = 0;
    std::vector<std::string> channels;
    double told = kNaN;  ///< amplitude in V or mA that the device was sent for the train that it shows; NaN: none
};

inline constexpr double kTrainLatency_s = 0.02;  ///< most that a pulse comes after its command

/// One train of pulses or burst of vibration, as it was planned, sent and reported.
struct ExportTrain {
    enum class Outcome {
        Delivered,
        Refused,  ///< by a limit, before it was sent
        Voided,   ///< a stop came before it was sent
        Failed,   ///< the device
        Check,    ///< an impedance check, delivered
        Burst,    ///< of a massager, delivered
        Unknown   ///< sent, and the session ends before the report
    };
    double time_s = kNaN;
    Outcome outcome = Outcome::Unknown;
    double roughness = kNaN, pressure = kNaN;  ///< R and P that it was made from
    double command_v = kNaN;                   ///< what the encoder wanted
    double told_v = kNaN, told_ma = kNaN;      ///< what the device was sent
    double readBack_v = kNaN, readBack_ma = kNaN;
    double interval_s = kNaN;
    double impedance_ohm = kNaN;
    double imbalance = kNaN;
    std::string drivenBy;      ///< "sensor", "manual", "presentation", "check"; empty if the session does not say
    double held_v = kNaN;      ///< `command_v` adapted to the load's impedance
    std::string limit;         ///< that it came nearest to: "rms_current_5s of paper"; empty if not known
    double limitShare = kNaN;  ///< of that limit
    double roundedBy = kNaN;   ///< share by which the device's step made the amplitude smaller; negative: larger
    std::string reason;        ///< why it was not delivered
    nlohmann::json details{};  ///< the session's row of the report; null if there is none
    bool simulated = false;
};
[[nodiscard]] std::string_view nameOf(ExportTrain::Outcome outcome) noexcept;  // "delivered"; "" for Unknown

/// A cell of a table. NaN and an empty text are absent.
using ExportCell = std::variant<double, std::string>;

/// A table of the session. The first column is `time_s`, the last `simulated` (0 or 1).
struct ExportTable {
    std::string name;  ///< "trials", "trains", "events", "records"
    std::string title;
    std::vector<ResultColumn> columns;  ///< `at` is the column's name; As::Text holds texts, all others numbers
    [[nodiscard]] static bool holdsText(const ResultColumn& column) noexcept {
        return column.as == ResultColumn::As::Text;
    }
};

/// A row of the session that is neither a sample, a capture, a trial nor a train.
struct ExportRow {
    double time_s = 0;
    std::string kind;  ///< of the session's row: "event", "command", "verdict", ...
    std::string name;
    nlohmann::json details;
};

class ExportSource {
public:
    /// Verifies the session and looks through its streams. `version`: of this program. `code`: of the participant,
    /// which no text of the export says; empty for none. Errors: as SessionReader::open() and verifySession();
    /// Unsupported for a sealed session without its seal; Stopped.
    [[nodiscard]] static Result<ExportSource> open(const std::filesystem::path& session,
                                                   std::shared_ptr<const RowSeal> seal, ExportWatch watch,
                                                   std::string_view version, std::string_view code = {});
    ExportSource(ExportSource&&) noexcept;
    ExportSource& operator=(ExportSource&&) noexcept;
    ~ExportSource();

    [[nodiscard]] const std::string& name() const noexcept;  ///< the file's name without its suffix
    [[nodiscard]] const SessionAbout& about() const noexcept;
    [[nodiscard]] const std::string& chainHead() const noexcept;
    [[nodiscard]] const std::string& wallStart() const noexcept;  ///< ISO 8601 UTC, at time 0
    [[nodiscard]] double duration_s() const noexcept;             ///< until the recording's last row
    [[nodiscard]] const std::string& version() const noexcept;    ///< of the program that exports
    [[nodiscard]] bool closed() const noexcept;
    [[nodiscard]] bool damaged() const noexcept;
    [[nodiscard]] const std::vector<std::string>& problems() const noexcept;  ///< what is damaged, in sentences
    /// Whether any device was simulated. Streams, captures and trains say it of themselves.
    [[nodiscard]] bool simulated() const noexcept;
    /// Whether what a table's rows tell of was simulated, as its last column says.
    [[nodiscard]] bool simulated(const ExportTable& table) const noexcept;
    /// What every file is marked with: "simulated", "uncalibrated R", "ended without closing", ...
    [[nodiscard]] const std::vector<std::string>& marks() const noexcept;
    [[nodiscard]] std::string marksText() const;  ///< joined by "; "
    /// Whether R is calibrated: at a time, and throughout.
    [[nodiscard]] bool calibratedR(double t_s) const noexcept;
    [[nodiscard]] bool calibratedR() const noexcept;
    /// session.json: all of the above, protocol, parameters, devices, labels and what each stream holds.
    [[nodiscard]] const nlohmann::json& description() const noexcept;

    [[nodiscard]] const std::vector<ExportStream>& streams() const noexcept;
    [[nodiscard]] const std::vector<ExportCapture>& captures() const noexcept;
    [[nodiscard]] const ExportTable& trials() const noexcept;
    [[nodiscard]] const ExportTable& trains() const noexcept;
    [[nodiscard]] const ExportTable& events() const noexcept;
    [[nodiscard]] const ExportTable& records() const noexcept;  ///< commands, measurements, verdicts, report, log
    /// trials(), trains(), events(), records().
    [[nodiscard]] std::vector<const ExportTable*> tables() const;

    /// Ends with the first error of `visit`, or Stopped.
    [[nodiscard]] Result<void> forEachChunk(const ExportStream& stream,
                                            const std::function<Result<void>(const SampleBlock&)>& visit) const;
    /// The same for the stamps alone, which takes less.
    [[nodiscard]] Result<void> forEachStamps(const ExportStream& stream,
                                             const std::function<Result<void>(std::span<const double>)>& visit) const;
    /// Nothing if damage made it, or what is stated of it, unreadable. Errors: Stopped.
    [[nodiscard]] Result<std::optional<Capture>> capture(const ExportCapture& capture) const;
    /// The rows of one of this session's tables, in order.
    [[nodiscard]] Result<void> forEachRow(const ExportTable& table,
                                          const std::function<Result<void>(std::span<const ExportCell>)>& visit) const;
    [[nodiscard]] Result<void> forEachTrain(const std::function<Result<void>(const ExportTrain&)>& visit) const;
    [[nodiscard]] std::uint64_t trainCount() const noexcept;
    [[nodiscard]] const std::vector<SessionTrial>& trialRows() const noexcept;
    [[nodiscard]] const std::vector<SessionRow>& eventRows() const noexcept;
    /// Events and records together, in the order of writing.
    [[nodiscard]] Result<void> forEachMoment(const std::function<Result<void>(const ExportRow&)>& visit) const;

    /// Stopped once the export was cancelled: asked by whoever computes for long without reading.
    [[nodiscard]] Result<void> goOn() const;

private:
    struct State;
    explicit ExportSource(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
