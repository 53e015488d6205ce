// CaptureFormat.h - what a kind of capture file is to the program: recognised, read, perhaps written.
//
// Each dialect of a format is a format of its own ("csv-rigol", "csv"), so that what was recognised can be shown and
// another can be named in its place. Readers stream: what they hold is the samples and a buffer, never the file.
//
// Thread-safety: a format is immutable; its functions may be called from any threads at once. progress() is called on
// the thread that reads.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/measure/Capture.h"

namespace tacto {

/// What the user knows better than the file. Empty = as the file says.
/// A channel is named by its name in the file (capitals ignored) or by its number: of the column in a table, of the
/// channel elsewhere, from 1.
struct ReadOptions {
    std::string format{};                          ///< id of a format; empty: recognised from the file
    std::size_t skipRows = 0;                      ///< lines at the beginning of a text that are passed over
    std::vector<std::string> columns{};            ///< the channels to keep, in this order
    std::string timeColumn{};                      ///< the column that holds the times
    std::map<std::string, std::string> units{};    ///< channel -> the unit of its numbers: "mV", "A"
    std::map<std::string, double> probeFactors{};  ///< channel -> its numbers are multiplied by this
    /// Channel -> the instrument's input range in V or A, for files that do not state it: a sample at or beyond an end
    /// is clipped.
    std::map<std::string, std::pair<double, double>> ranges{};
    std::optional<Hertz> rate{};  ///< the rate for files without times; replaces one that the file states
};

/// Watches a long reading, and can end it.
struct ReadWatch {
    std::function<void(double fraction)> progress{};  ///< 0 to 1, rising; may be empty
    std::stop_token stop{};
};

/// Reports `fraction` and looks at the stop: a reader calls it after each chunk (at most a few MB apart).
/// Errors: Stopped when a stop was requested.
[[nodiscard]] Result<void> keepReading(const ReadWatch& watch, double fraction, std::string_view file);

struct CaptureReading {
    Capture capture;                    ///< samples in V and A; trigger_s is NaN where the file does not say
    std::vector<std::string> warnings;  ///< sentences: what was tolerated or guessed, with line numbers
    std::string formatId;               ///< the format that it was: set by CaptureFormats::read()
    std::string formatName;             ///< the format's name, for people
};

/// What SCPI instruments write for a sample that has no value: 9.9E37 (infinity) or 9.91E37 (not a number), of either
/// sign (SCPI-1999, volume 1, 7.2.1). Asked of the number in the file, before a unit scales it; such a sample is NaN.
[[nodiscard]] constexpr bool isNoValue(double number) noexcept { return number >= 9.8e37 || number <= -9.8e37; }
/// The sentence about `count` of them in channel `name`.
[[nodiscard]] std::string noValueWarning(std::string_view file, std::string_view name, std::size_t count);
/// Makes those among samples that were read NaN, with a warning for each channel.
void dropNoValues(CaptureReading& reading, std::string_view file);

/// What `read` gives; where its samples do not fit into memory, Io naming `file` in place of an exception.
[[nodiscard]] Result<CaptureReading> readWithinMemory(std::string_view file,
                                                      const std::function<Result<CaptureReading>()>& read);

/// What recognises() is shown: the file's beginning, at most kHeadBytes of it.
constexpr std::size_t kHeadBytes = 64UL * 1024;

class CaptureFormat {
public:
    virtual ~CaptureFormat() = default;

    /// Short and stable, for --format and JSON: "csv-rigol".
    [[nodiscard]] virtual std::string_view id() const noexcept = 0;
    /// The name for people: "Rigol CSV".
    [[nodiscard]] virtual std::string_view name() const noexcept = 0;
    /// The suffixes of its files, lower case with the dot: {".csv", ".txt"}. The first is the usual one.
    [[nodiscard]] virtual std::vector<std::string_view> suffixes() const = 0;

    /// Whether a file of this name that begins with `head` has this format. Never reads the file.
    [[nodiscard]] virtual bool recognises(const std::filesystem::path& path, std::string_view head) const = 0;

    /// Errors: NotFound, Io; ParseError naming file, place (line or byte) and what was expected; InvalidArgument for an
    /// option that the file cannot honour; Stopped. What was read until then is dropped. Throws std::bad_alloc where
    /// the samples do not fit into memory: see readWithinMemory().
    [[nodiscard]] virtual Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                                      const ReadWatch& watch) const = 0;

    [[nodiscard]] virtual bool canWrite() const noexcept { return false; }
    /// Replaces the file by a whole one, or leaves it. Errors: InvalidArgument for a capture that the format cannot
    /// hold (no samples, no rate, channels of unequal length), Io with the system's reason, Unsupported where
    /// canWrite() is false.
    [[nodiscard]] virtual Result<void> write(const std::filesystem::path& path, const Capture& capture) const;

protected:
    CaptureFormat() = default;
    CaptureFormat(const CaptureFormat&) = default;
    CaptureFormat& operator=(const CaptureFormat&) = default;
};

}  // namespace tacto
