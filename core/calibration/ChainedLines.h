// ChainedLines.h - a file of JSON lines that only grows, and in which a change is found.
//
// Each line carries the SHA-256 of the line before it ("previous") and its own ("sha256"): a line that was changed,
// taken out or put in is found when the file is read. Lines that are taken off the end are not. The last line may be
// cut short by a crash while it was written: it is left out, lastLineCut() says so, and append() writes over it.
//
// Thread-safety: none; one owner. append() locks the file against other processes.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/Result.h"

namespace tacto {

class ChainedLines {
public:
    /// `what` is what a line holds, for messages: "calibration".
    ChainedLines(std::filesystem::path file, std::string what) : file_(std::move(file)), what_(std::move(what)) {}

    /// Reads the file from its first line; one that is not there is empty. `take` gets every line and says what is
    /// wrong with it. Errors: Io; ParseError naming the line that does not check, or that `take` refuses.
    [[nodiscard]] Result<void> read(const std::function<Result<void>(const nlohmann::json& line)>& take);

    /// Appends and syncs what `line` returns. It is called when the file is locked, and has to read() it: another
    /// process may have appended. Errors: Io, also when another program holds the file for 2 s; as `line`.
    [[nodiscard]] Result<void> append(const std::function<Result<nlohmann::json>()>& line);

    [[nodiscard]] bool lastLineCut() const noexcept { return cut_; }

private:
    std::filesystem::path file_;
    std::string what_;
    std::string head_;  // SHA-256 of the last line; empty before the first
    std::size_t wholeBytes_ = 0;
    bool cut_ = false;
};

/// $XDG_DATA_HOME/tactoscope/NAME, or ~/.local/share/tactoscope/NAME.
[[nodiscard]] std::filesystem::path labFile(std::string_view name);

}  // namespace tacto
