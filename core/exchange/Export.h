// Export.h - the formats in which a session leaves the program, and the one function that writes them.
//
// A format is a folder here with one ExportFormat, which ExportFormats.cpp lists. It reads an ExportSource and fills
// the private file or folder that it is given; naming, syncing, hashing and removing are done for it. What it cannot
// hold it says once, in `cannot`; each export then names what its session has of that.
//
// Thread-safety: any thread; the formats are constants.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/ExportSource.h"
#include "core/exchange/ExportTarget.h"

namespace tacto {

enum class ExportContent { Streams, Captures, Trials, Trains, Events, Records };
[[nodiscard]] std::string_view nameOf(ExportContent content) noexcept;  // "captures"

/// What was written of a channel.
struct ExportedChannel {
    std::string name;
    std::string unit;
    bool exact = true;    ///< every value reads back as it was
    double step = kNaN;   ///< between two values that the file can hold; NaN: exact
    double maxError = 0;  ///< in `unit`
    std::uint64_t absent = 0;
};
struct ExportedStream {
    std::string name;
    std::uint64_t samples = 0;
    double rate_hz = kNaN;
    std::uint64_t gaps = 0, repeated = 0, dropped = 0;
    double maxTimeError_s = 0;
    std::vector<ExportedChannel> channels = {};
};
struct ExportedFile {
    std::string path;  ///< relative to a folder, else the file's name
    std::uint64_t bytes = 0;
    std::string sha256;
};
struct LeftOut {
    std::string what;
    std::string why;
};

/// What an export wrote. A format fills `streams` and adds to `leftOut`.
struct ExportReport {
    std::string format;
    std::filesystem::path out;
    std::string session;  ///< its path, as it was asked for
    std::string chainHead;
    bool simulated = false;
    bool damaged = false;
    std::vector<std::string> marks;
    std::vector<std::string> problems;  ///< sentences, of a damaged session
    std::vector<ExportedFile> files;
    std::vector<ExportedStream> streams;
    std::vector<LeftOut> leftOut;

    /// Adds a stream that was written exactly, with every stamp.
    void wroteExactly(const ExportStream& stream);
};
/// The value of `export --json` (exchange.md section 5).
[[nodiscard]] nlohmann::json toJson(const ExportReport& report);

struct ExportFormat {
    struct Cannot {
        ExportContent content;
        std::string_view why;  ///< "EDF holds no records of microseconds"
    };
    std::string_view name;    ///< "csv"
    std::string_view title;   ///< "CSV: a folder of tables"
    std::string_view suffix;  ///< of its file: ".h5"; empty: it is a folder
    std::vector<Cannot> cannot;
    /// Fills `draft`, an empty private file or folder. Errors: Io; Stopped; Unsupported if the session holds nothing
    /// that this format can hold.
    Result<void> (*write)(const ExportSource& source, const std::filesystem::path& draft, ExportReport& report);
    /// About how large the export becomes, in bytes.
    std::uint64_t (*size)(const ExportSource& source) = nullptr;

    [[nodiscard]] ExportTarget::Kind kind() const noexcept {
        return suffix.empty() ? ExportTarget::Kind::Folder : ExportTarget::Kind::File;
    }
};

/// The formats for every session.
[[nodiscard]] std::span<const ExportFormat* const> exportFormats();
/// One of those, or "dcc", which is for the calibration of a stimulator alone. Null if there is no such format.
[[nodiscard]] const ExportFormat* exportFormat(std::string_view name);

/// What this session has and the format cannot hold.
[[nodiscard]] std::vector<LeftOut> leftOutOf(const ExportSource& source, const ExportFormat& format);

/// Writes the session to `out`, which must be new. `seal`, `code`: as ExportSource::open() takes them. Errors: as
/// ExportSource::open(), ExportTarget and the format's write(); then nothing is left.
[[nodiscard]] Result<ExportReport> exportSession(const std::filesystem::path& session, const ExportFormat& format,
                                                 const std::filesystem::path& out, std::string_view version,
                                                 const ExportWatch& watch = {},
                                                 std::shared_ptr<const RowSeal> seal = nullptr,
                                                 std::string_view code = {});

}  // namespace tacto
