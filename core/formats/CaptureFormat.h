// CaptureFormat.h - the interface of a capture file format: it recognises files, reads them and perhaps writes them.
//
// Each dialect is a format of its own ("csv-rigol", "csv"), so that the program can show which one it recognised and
// the user can choose another. Readers stream: they hold the samples and a buffer, never the whole file.
//
// Thread-safety: a format is immutable; any threads may call its functions at once. progress() is called on the thread
// that reads.
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

/// Options of the user that override the file. Empty: as stated in the file. A channel is named by its name in the file
/// (case ignored) or by its number, from 1: of the column in a table, of the channel in other files.
struct ReadOptions {
    std::string format{};                          ///< id of a format; empty: the file is recognised
    std::size_t skipRows = 0;                      ///< lines to skip at the beginning of a text
    std::vector<std::string> columns{};            ///< channels to keep, in this order
    std::string timeColumn{};                      ///< column that holds the times
    std::map<std::string, std::string> units{};    ///< channel -> unit of its numbers: "mV", "A"
    std::map<std::string, double> probeFactors{};  ///< channel -> factor for its numbers
    /// Channel -> input range of the instrument in V or A, for files that do not state it: a sample at or beyond either
    /// end is clipped.
    std::map<std::string, std::pair<double, double>> ranges{};
    std::optional<Hertz> rate{};  ///< sampling rate for files without times; overrides a rate in the file
};

/// Reports the progress of a long read and can stop it.
struct ReadWatch {
    std::function<void(double fraction)> progress{};  ///< 0 to 1, never decreasing; may be empty
    std::stop_token stop{};
};

/// Reports `fraction` and checks for a stop request. A reader calls this after each chunk (at most a few MB). Errors:
/// Stopped when a stop was requested.
[[nodiscard]] Result<void> keepReading(const ReadWatch& watch, double fraction, std::string_view file);

struct CaptureReading {
    Capture capture;                    ///< samples in V and A; trigger_s is NaN if the file does not state it
    std::vector<std::string> warnings;  ///< sentences with line numbers: what was tolerated or guessed
    std::string formatId;               ///< format that was used: set by CaptureFormats::read()
    std::string formatName;             ///< name of the format, for people
};

/// Returns true for the numbers that SCPI instruments write for a sample without a value: 9.9E37 (infinity) or 9.91E37
/// (not a number), of either sign (SCPI-1999, volume 1, 7.2.1). Check it before unit scaling. Such a sample is NaN.
[[nodiscard]] constexpr bool isNoValue(double number) noexcept { return number >= 9.8e37 || number <= -9.8e37; }
/// Returns a warning about `count` samples without a value in channel `name`.
[[nodiscard]] std::string noValueWarning(std::string_view file, std::string_view name, std::size_t count);
/// Replaces samples without a value by NaN, with a warning for each channel.
void dropNoValues(CaptureReading& reading, std::string_view file);

/// Calls `read` and returns its result. If the samples do not fit into memory, returns the error Io naming `file`.
[[nodiscard]] Result<CaptureReading> readWithinMemory(std::string_view file,
                                                      const std::function<Result<CaptureReading>()>& read);

/// Size of a file's beginning that recognises() receives.
constexpr std::size_t kHeadBytes = 64UL * 1024;

class CaptureFormat {
public:
    virtual ~CaptureFormat() = default;

    /// Returns a short, stable id for --format and JSON: "csv-rigol".
    [[nodiscard]] virtual std::string_view id() const noexcept = 0;
    /// Returns the name for people: "Rigol CSV".
    [[nodiscard]] virtual std::string_view name() const noexcept = 0;
    /// Returns the file suffixes, lower case with the dot: {".csv", ".txt"}. The first is the usual one.
    [[nodiscard]] virtual std::vector<std::string_view> suffixes() const = 0;

    /// Returns whether a file with this path, beginning with `head`, has this format. Does not read the file.
    [[nodiscard]] virtual bool recognises(const std::filesystem::path& path, std::string_view head) const = 0;

    /// Reads a file. Errors: NotFound, Io; ParseError naming file, place (line or byte) and what was expected;
    /// InvalidArgument for an option that does not fit the file; Stopped. After an error no samples are kept. Throws
    /// std::bad_alloc if the samples do not fit into memory: see readWithinMemory().
    [[nodiscard]] virtual Result<CaptureReading> read(const std::filesystem::path& path, const ReadOptions& options,
                                                      const ReadWatch& watch) const = 0;

    [[nodiscard]] virtual bool canWrite() const noexcept { return false; }
    /// Replaces the file as a whole, or leaves it unchanged. Errors: InvalidArgument for a capture that the format
    /// cannot hold (no samples, no rate, channels of unequal length), Io with the system's reason, Unsupported if
    /// canWrite() is false.
    [[nodiscard]] virtual Result<void> write(const std::filesystem::path& path, const Capture& capture) const;

protected:
    CaptureFormat() = default;
    CaptureFormat(const CaptureFormat&) = default;
    CaptureFormat& operator=(const CaptureFormat&) = default;
};

}  // namespace tacto
