// SessionTypes.h - what a session file holds, as its writer takes it and its reader gives it back.
//
// Thread-safety: values.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Units.h"
#include "core/base/Words.h"

namespace tacto {

/// Measurements that the program alone writes: what its report says of exposure, and what a calibration rests on.
inline constexpr const char* kExposureMeasurement = "exposure";
inline constexpr const char* kCalibrationMeasurement = "calibration to keep";

/// Events that hold the session's marks (core/session/Origin.h): all of them when the bench closes, and each flag of R
/// at once when it first drives the output.
inline constexpr const char* kMarksEvent = "marks";
inline constexpr const char* kMarkEvent = "mark";
/// The stimulator's output differs from what was set; the text is a mark of the session.
inline constexpr const char* kMeasuredBeyondEvent = "measured beyond";
/// The operator marked this moment; the word is body["text"].
inline constexpr const char* kOperatorMarkEvent = "operator mark";
/// The sentence on how the oscilloscope's calibration certificate stood when the session began.
inline constexpr const char* kCertificateEvent = "oscilloscope certificate";

/// One device of the session.
struct SessionDevice {
    std::string uri;
    std::string role;  ///< its word
    std::string name;
    std::string serial;
    std::string firmware;
    bool simulated = false;
    std::string origin{};  ///< one of core/session/Origin.h; empty in sessions older than it
    [[nodiscard]] bool is(Role wanted) const noexcept { return role == nameOf(wanted); }
    bool operator==(const SessionDevice&) const = default;
};

struct SessionLimitSet {
    std::string id;      ///< "paper", "iec-60601-2-10", ...
    std::string sha256;  ///< digest of the limit file's bytes
    std::string from{};  ///< where the file lay; empty for a set that is built into the program
    bool operator==(const SessionLimitSet&) const = default;
};

/// The equipment and the beginning: everything a report says before its first figure. Written once, first.
struct SessionAbout {
    std::string programVersion;
    std::string protocol;        ///< name, e.g. "separability"; empty for a session without a script
    std::string protocolSha256;  ///< digest of the script's bytes
    std::string protocolFrom;    ///< where the script came from: "shipped with the program", or its path
    nlohmann::json parameters = nlohmann::json::object();
    std::uint64_t seed = 0;
    std::vector<SessionDevice> devices;
    std::string profileJson;    ///< the encoding profile as text
    std::string profileSha256;  ///< digest of profileJson; filled in by the writer when empty
    std::vector<SessionLimitSet> limitSets;
    bool simulated = false;     ///< true when any device is: the report is watermarked
    std::string mode;           ///< "bench load" or "person"
    std::string wallStart;      ///< ISO 8601 UTC, wallTimeUtc() ...
    Instant wallStartAt{0};     ///< ... read at this moment of the session's time base
    bool virtualClock = false;  ///< filled in by the writer from its clock
};

/// People's words on a session: as entered before it began, and as changed after it ended (SessionLabels.h).
struct SessionLabels {
    std::string operatorName;
    std::string sample;  ///< the measured sample, by the laboratory's own id
    std::string note;
    std::vector<std::string> tags;
    bool operator==(const SessionLabels&) const = default;
};

/// A stream to be recorded: sensor data, roughness frames, telemetry. All columns share the time stamps.
struct SessionStream {
    std::string name;                  ///< free text: "fingertip accelerometer", "roughness frames"
    std::string kind;                  ///< "acceleration", "force", "taxels", "frames", "telemetry", ...
    std::string unit;                  ///< "m/s2", "N", "Pa", "count"; empty when `columns` carry theirs
    std::vector<std::string> columns;  ///< at least one: "x", "c1", "pressure_pa"
    double rate_hz = 0;                ///< nominal; 0 = none
    bool operator==(const SessionStream&) const = default;
};

/// A stream as it lies in a file.
struct SessionStreamInfo {
    int id = 0;  ///< 1, 2, ... in the order of addStream()
    SessionStream stream;
    std::uint64_t samples = 0;
    double first_s = 0;  ///< first time stamp; NaN without samples
    double last_s = 0;
};

/// An event, command, measurement, report item or log line.
struct SessionRow {
    std::int64_t seq = 0;  ///< place in the hash chain, from 1
    Instant at{0};
    std::string name;     ///< event kind, command, measured quantity; a log line's level
    nlohmann::json body;  ///< a log line's text is body["text"]
    bool sealed = false;  ///< the row is sealed and there is no key: name and body hold what is shown (SealedRow.h)
};

struct SessionTrial {
    std::int64_t seq = 0;
    int number = 0;  ///< from 1, without holes
    Instant at{0};
    std::string condition;
    nlohmann::json measured;
    bool sealed = false;  ///< like SessionRow's; the condition reads "sealed"
};

struct SessionVerdict {
    std::int64_t seq = 0;
    Instant at{0};
    std::string subject;
    std::string verdict;  ///< "pass", "fail", "indeterminate", "stopped"; "none": found, and not judged
    std::vector<std::string> reasons;
    nlohmann::json results;
    bool sealed = false;  ///< like SessionRow's; subject and verdict read "sealed"
};

/// A capture without its samples; SessionReader::capture(seq) reads those.
struct SessionCaptureInfo {
    std::int64_t seq = 0;
    Instant at{0};
    std::optional<int> trial;  ///< number of the trial it belongs to
    double rate_hz = 0;
    std::uint64_t samples = 0;
    std::vector<std::string> channels;
    bool simulated = false;
    bool sealed = false;  ///< like SessionRow's; only seq, at and trial are known
};

// SessionAbout and SessionStream as the JSON of their log rows.

[[nodiscard]] nlohmann::json toJson(const SessionAbout& about);
/// Missing fields stay empty.
[[nodiscard]] SessionAbout aboutFrom(const nlohmann::json& json);
/// The part that the same seed must reproduce: wall time, versions and paths left out.
[[nodiscard]] nlohmann::json reproducible(const SessionAbout& about);

[[nodiscard]] nlohmann::json toJson(const SessionStream& stream);
[[nodiscard]] SessionStream streamFrom(const nlohmann::json& json);

}  // namespace tacto
