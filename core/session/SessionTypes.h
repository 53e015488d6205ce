// SessionTypes.h - the contents of a session file, as its writer takes them and its reader returns them.
//
// Thread-safety: values.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/base/Words.h"

namespace tacto {

/// Measurements that only the program itself writes: exposure for the report, and the basis of a calibration.
inline constexpr const char* kExposureMeasurement = "exposure";
inline constexpr const char* kCalibrationMeasurement = "calibration to keep";

/// Events with the session's marks (core/session/Origin.h): all marks when the bench closes, and each flag of R as soon
/// as R drives the output with that flag.
inline constexpr const char* kMarksEvent = "marks";
inline constexpr const char* kMarkEvent = "mark";
/// The stimulator's output was measured beyond what was set; the text is a mark of the session.
inline constexpr const char* kMeasuredBeyondEvent = "measured beyond";
/// The operator marked this moment; body["text"] is the word.
inline constexpr const char* kOperatorMarkEvent = "operator mark";
/// A sentence about the state of the oscilloscope's calibration certificate when the session began.
inline constexpr const char* kCertificateEvent = "oscilloscope certificate";

/// One device of the session.
struct SessionDevice {
    std::string uri;
    std::string role;  ///< name of the role
    std::string name;
    std::string serial;
    std::string firmware;
    bool simulated = false;
    std::string origin{};  ///< one of the values in core/session/Origin.h; empty in older sessions
    [[nodiscard]] bool is(Role wanted) const noexcept { return role == nameOf(wanted); }
    bool operator==(const SessionDevice&) const = default;
};

struct SessionLimitSet {
    std::string id;      ///< "paper", "iec-60601-2-10", ...
    std::string sha256;  ///< digest of the limit file's bytes
    std::string from{};  ///< path of the limit file; empty for a set that is built into the program
    bool operator==(const SessionLimitSet&) const = default;
};

/// The equipment and the start of a session: what a report states before its first figure. The first row, written once.
struct SessionAbout {
    std::string programVersion;
    std::string protocol;        ///< name, e.g. "separability"; empty for a session without a script
    std::string protocolSha256;  ///< digest of the script's bytes
    std::string protocolFrom;    ///< "shipped with the program", or the script's path
    nlohmann::json parameters = nlohmann::json::object();
    std::uint64_t seed = 0;
    std::vector<SessionDevice> devices;
    std::string profileJson;    ///< the encoding profile as text
    std::string profileSha256;  ///< digest of profileJson; the writer sets it if it is empty
    std::vector<SessionLimitSet> limitSets;
    bool simulated = false;     ///< true if any device is simulated: the report gets a watermark
    std::string mode;           ///< "bench load" or "person"
    std::string wallStart;      ///< ISO 8601 UTC, by wallTimeUtc()
    Instant wallStartAt{0};     ///< session time at which wallStart was read
    bool virtualClock = false;  ///< set by the writer from its clock
};

/// People's words about a session, entered before it began or changed after it ended (SessionLabels.h).
struct SessionLabels {
    std::string operatorName;
    std::string sample;  ///< the measured sample, by the laboratory's own id
    std::string note;
    std::vector<std::string> tags;
    bool operator==(const SessionLabels&) const = default;
};

/// A stream to be recorded, such as sensor data, roughness frames or telemetry. All columns share the time stamps.
struct SessionStream {
    std::string name;                  ///< free text: "fingertip accelerometer", "roughness frames"
    std::string kind;                  ///< "acceleration", "force", "taxels", "frames", "telemetry", ...
    std::string unit;                  ///< "m/s2", "N", "Pa", "count"; empty if the names in `columns` include units
    std::vector<std::string> columns;  ///< at least one: "x", "c1", "pressure_pa"
    double rate_hz = 0;                ///< nominal; 0 = none
    bool operator==(const SessionStream&) const = default;
};

/// A stream as the file describes it.
struct SessionStreamInfo {
    int id = 0;  ///< 1, 2, ... in the order of addStream()
    SessionStream stream;
    std::uint64_t samples = 0;
    double first_s = 0;  ///< first time stamp; NaN without samples
    double last_s = 0;
};

/// An event, command, measurement, report item or log line.
struct SessionRow {
    std::int64_t seq = 0;  ///< position in the hash chain, from 1
    Instant at{0};
    std::string name;     ///< kind of event, command or measured quantity; or the level of a log line
    nlohmann::json body;  ///< body["text"] is the text of a log line
    bool sealed = false;  ///< sealed, without a key: name and body hold only what is shown (SealedRow.h)
};

struct SessionTrial {
    std::int64_t seq = 0;
    int number = 0;  ///< from 1, without gaps
    Instant at{0};
    std::string condition;
    nlohmann::json measured;
    bool sealed = false;  ///< as in SessionRow; the condition then reads "sealed"
};

struct SessionVerdict {
    std::int64_t seq = 0;
    Instant at{0};
    std::string subject;
    std::string verdict;  ///< "pass", "fail", "indeterminate", "stopped"; "none": results without a verdict
    std::vector<std::string> reasons;
    nlohmann::json results;
    bool sealed = false;  ///< as in SessionRow; subject and verdict then read "sealed"
};

/// A capture without its samples, which SessionReader::capture(seq) reads.
struct SessionCaptureInfo {
    std::int64_t seq = 0;
    Instant at{0};
    std::optional<int> trial;  ///< number of the trial that the capture belongs to
    double rate_hz = 0;
    double start_s = kNaN, trigger_s = kNaN;  ///< as in Capture
    std::uint64_t samples = 0;
    std::vector<std::string> channels;
    bool simulated = false;
    bool sealed = false;  ///< as in SessionRow; only seq, at and trial are known
};

// SessionAbout and SessionStream as the JSON in their rows of the log.

[[nodiscard]] nlohmann::json toJson(const SessionAbout& about);
/// Missing members stay empty.
[[nodiscard]] SessionAbout aboutFrom(const nlohmann::json& json);
/// Returns the part that the same seed must reproduce, without wall time, versions and paths.
[[nodiscard]] nlohmann::json reproducible(const SessionAbout& about);

[[nodiscard]] nlohmann::json toJson(const SessionStream& stream);
[[nodiscard]] SessionStream streamFrom(const nlohmann::json& json);

}  // namespace tacto
