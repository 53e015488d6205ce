// Recording.h - sensor data from elsewhere, opened as they are: recording.json beside CSV files.
//
// Units are converted on reading (g to m/s2, kPa to Pa); time stamps become seconds and keep their zero. Anything wrong
// is refused with one sentence that names file, line and what was expected; anything merely irregular (gaps, repeats,
// clock steps, cells that are empty or say nan) is read and reported in each stream's health.
//
// Keys that are not known are taken as notes and passed over.
//
// Thread-safety: values; functions are pure but for reading files. Nothing is ever written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/acquisition/StreamHealth.h"
#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

struct RecordedStream {
    StreamInfo info;  ///< rate_hz is measured; name is the file's
    /// The samples as recorded: stamps may step back, values may be NaN. Counts that stand alone, far from all others,
    /// are infinite.
    SampleBlock samples;
    HealthReport health;
    std::filesystem::path file;
};

struct Recording {
    std::string title;
    std::string source;
    std::string licence;
    std::optional<bool> simulated;  ///< "simulated": as the file says; nothing: its origin is unknown
    std::string fingertip;          ///< "fingertip": serial number of the sensor that was recorded; empty: not stated
    std::filesystem::path path;     ///< the JSON file
    DeclaredIntervals declared;
    std::vector<RecordedStream> streams;  ///< at most one of each kind

    /// `path` is a folder with recording.json, such a JSON file, or a table that one beside it names.
    /// Errors: NotFound (no recording.json: the message says how to get one to fill in); ParseError;
    /// InvalidArgument (an unknown kind or unit, a `file` that is absolute or climbs out); Io.
    [[nodiscard]] static Result<Recording> open(const std::filesystem::path& path);

    /// The stream of that kind, or null.
    [[nodiscard]] const RecordedStream* find(StreamKind kind) const noexcept;
    /// Earliest and latest stamp over all streams.
    [[nodiscard]] TimeInterval extent() const noexcept;
    /// The streams as RoughnessChain and analyseRoughness() take them, in the order of `streams`.
    [[nodiscard]] std::vector<StreamInfo> infos() const;
    [[nodiscard]] std::vector<SampleBlock> blocks() const;
};

/// The description beside `table` that names it as a stream's file: FILE.json for FILE.csv, or recording.json. Empty:
/// no readable one exists.
[[nodiscard]] std::filesystem::path descriptionBeside(const std::filesystem::path& table);

/// A recording.json to fill in, for a folder that has none.
[[nodiscard]] std::string recordingTemplate();

}  // namespace tacto
