// ChainedLines.h - a file of JSON lines that only grows, and in which a change is found.
//
// Each line carries the SHA-256 of the line before it ("previous") and its own ("sha256"): a line that was changed,
// taken out or put in is found when the file is read. FILE.end notes where the last line ended: lines that were taken
// off the end are found too, also where an older copy of the file was put back. Lines say that it is kept
// ("end_noted"), so that its loss is noticed; a file without such lines is older than this check. A program that can
// write both files can still make them agree.
//
// The last line may be cut short by a crash while it was written: it is left out, lastLineCut() says so, and append()
// writes over it.
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
    /// `what` is what a line holds, for messages: "calibration".
    ChainedLines(std::filesystem::path file, std::string what) : file_(std::move(file)), what_(std::move(what)) {}

    /// Reads the file from its first line; one that is not there is empty. `take` gets every line and says what is
    /// wrong with it. Errors: Io; ParseError naming the line that does not check, or that `take` refuses, or saying
    /// that lines are missing.
    [[nodiscard]] Result<void> read(const std::function<Result<void>(const nlohmann::json& line)>& take);

    /// Appends and syncs what `line` returns. It is called when the file is locked, and has to read() it: another
    /// process may have appended. Errors: Io, also when another program holds the file for 2 s, and when the line is
    /// kept and its end cannot be noted; as `line`.
    [[nodiscard]] Result<void> append(const std::function<Result<nlohmann::json>()>& line);

    [[nodiscard]] bool lastLineCut() const noexcept { return cut_; }

private:
    /// The place where the lines end.
    struct End {
        std::size_t bytes = 0;
        std::string head;  ///< SHA-256 of the last line; empty before the first
        bool operator==(const End&) const = default;
    };
    [[nodiscard]] std::filesystem::path noteFile() const;
    /// Nothing where no note exists. Errors: Io; ParseError.
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
