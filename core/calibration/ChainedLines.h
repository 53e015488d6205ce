// ChainedLines.h - a file of JSON lines that only grows, and in which any change is detected.
//
// Each line contains the SHA-256 of the previous line ("previous") and its own ("sha256"), so that a line that was
// changed, removed or inserted is found when the file is read. FILE.end notes where the last line ends, so that lines
// missing at the end are found, too, also if an older copy was put back. Lines say that this note exists ("end_noted"),
// so that its loss is noticed; a file without such lines is older than this check. A program that can write both files
// can still make them agree.
//
// A crash may cut the last line short while it is written: read() then skips the line, lastLineCut() returns true, and
// append() overwrites the line.
//
// Thread-safety: none; one owner. append() locks the file against other processes.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

class ChainedLines {
public:
    /// `what` names the content of a line in messages: "calibration".
    ChainedLines(std::filesystem::path file, std::string what) : file_(std::move(file)), what_(std::move(what)) {}

    /// Reads the file from its first line; a missing file is empty. Passes every line to `take`, which returns an error
    /// for a bad line. Errors: Io; ParseError naming the line that is not valid, or that `take` refuses, or saying that
    /// lines are missing.
    [[nodiscard]] Result<void> read(const std::function<Result<void>(const nlohmann::json& line)>& take);

    /// Appends and syncs what `line` returns. `line` is called with the file locked and must call read(), because
    /// another process may have appended. Errors: those of `line`; Io, also if another program holds the file for
    /// 2 s, or if the line was written but its end could not be noted.
    [[nodiscard]] Result<void> append(const std::function<Result<nlohmann::json>()>& line);

    [[nodiscard]] bool lastLineCut() const noexcept { return cut_; }

private:
    /// The place where the last line ends.
    struct End {
        std::size_t bytes = 0;
        std::string head;  ///< SHA-256 of the last line; empty before the first
        bool operator==(const End&) const = default;
    };
    [[nodiscard]] std::filesystem::path noteFile() const;
    /// Returns nothing if no note exists. Errors: Io; ParseError.
    [[nodiscard]] Result<std::optional<End>> notedEnd() const;
    [[nodiscard]] Result<void> noteEnd() const;
    [[nodiscard]] Result<void> readLines(std::string_view text, const std::optional<End>& noted,
                                         const std::function<Result<void>(const nlohmann::json& line)>& take);

    std::filesystem::path file_;
    std::string what_;
    End end_;
    bool hasNote_ = false;
    bool cut_ = false;
};

/// $XDG_DATA_HOME/tactoscope/NAME, or ~/.local/share/tactoscope/NAME.
[[nodiscard]] std::filesystem::path labFile(std::string_view name);

}  // namespace tacto
