// Recording.h - opens sensor data from other sources: CSV, EDF, BDF and XDF files with a recording.json next to them.
//
// Units are converted on reading (g to m/s2, kPa to Pa); time stamps become seconds and keep their zero. Errors are
// refused with one sentence that names file, line and what was expected. Irregularities (gaps, repeats, clock steps,
// cells that are empty or say nan) are read, and reported in each stream's health.
//
// Unknown keys are treated as notes and ignored.
//
// Thread-safety: plain values; functions read files and have no other side effects. Nothing is ever written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/acquisition/SignalFile.h"
#include "core/acquisition/StreamHealth.h"
#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

struct RecordedStream {
    StreamInfo info;  ///< rate_hz is measured; name is the file's name
    /// The samples as recorded: stamps may step back, and values may be NaN. A single count far from all others is
    /// replaced by infinity.
    SampleBlock samples;
    HealthReport health;
    std::filesystem::path file;
    bool stamped = false;  ///< each sample has its own stamp in the file, which is never changed
};

struct Recording {
    std::string title;
    std::string source;
    std::string licence;
    std::optional<bool> simulated;  ///< "simulated" in the file; nothing: the origin is unknown
    std::string fingertip;          ///< "fingertip": serial number of the recorded sensor; empty: not stated
    std::filesystem::path path;     ///< the JSON file
    DeclaredIntervals declared;
    std::vector<RecordedStream> streams;  ///< at most one of each kind
    std::vector<std::string> warnings;    ///< what of its files could not be read, one sentence each

    /// Opens a recording. `path` is a folder with recording.json, such a JSON file, or a table that a JSON file next to
    /// it names; of files that `reader` knows also one whose channels are named as our exports name them. Errors:
    /// NotFound (no recording.json: the message says how to create one, or lists what a file that `reader` knows holds,
    /// with a recording.json for it on the lines below); ParseError; InvalidArgument (an unknown kind or unit, a `file`
    /// that is absolute or leaves the folder); Io.
    [[nodiscard]] static Result<Recording> open(const std::filesystem::path& path, const SignalReader& reader = {});

    /// Returns the stream of this kind, or null.
    [[nodiscard]] const RecordedStream* find(StreamKind kind) const noexcept;
    /// Returns the earliest and the latest stamp of all streams.
    [[nodiscard]] TimeInterval extent() const noexcept;
    /// Return the streams in the form that RoughnessChain and analyseRoughness() take, in the order of `streams`.
    [[nodiscard]] std::vector<StreamInfo> infos() const;
    [[nodiscard]] std::vector<SampleBlock> blocks() const;
};

/// Finds the description next to `table` that names it as a stream's file: FILE.json for FILE.csv, or recording.json.
/// Returns an empty path if there is no readable one.
[[nodiscard]] std::filesystem::path descriptionBeside(const std::filesystem::path& table);

/// Returns a recording.json to be filled in, for a folder without one.
[[nodiscard]] std::string recordingTemplate();

}  // namespace tacto
