// SessionWriter.h - makes a session file (*.tacto): one append-only SQLite log with its rows on a hash chain.
//
// Promise (hazard H8): when event(), trial(), verdict() or reportItem() returned a value, that row survives kill -9
// and power loss. Samples, commands, captures, measurements and log lines are committed at least once a second of the
// session's clock, and with every row named before; that disk write runs beside the caller. On a virtual clock those
// once-a-second commits survive kill -9 but wait for the next acknowledged row before they survive power loss. Nothing
// is lost silently: the first error of the disk is returned by the call that met it and by every call after it, and
// failed() says so to anyone.
//
// With a virtual clock the same calls write the same rows and chunks, whatever the machine.
//
// Thread-safety: any thread, one call at a time inside (a mutex). Calls may block for a disk write: a control loop on
// the steady clock goes through SessionRecorder instead.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/measure/Capture.h"
#include "core/session/RowSeal.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionWriter {
public:
    /// Makes the file, with `about` as its first row. A crash inside leaves no session or a valid one.
    /// `clock` is the session's and must outlive the writer. With a `seal`, what the rows say is stored sealed
    /// (SealedRow.h).
    /// Errors: InvalidArgument when `path` exists (never overwritten); Io naming the path and the reason.
    [[nodiscard]] static Result<std::unique_ptr<SessionWriter>> create(const std::filesystem::path& path,
                                                                       SessionAbout about, const Clock& clock,
                                                                       std::shared_ptr<const RowSeal> seal = nullptr);
    /// Closes as close() does, where that was not called.
    ~SessionWriter();
    SessionWriter(const SessionWriter&) = delete;
    SessionWriter& operator=(const SessionWriter&) = delete;

    /// Returns the id for append(). Errors: InvalidArgument without columns; Io.
    [[nodiscard]] Result<int> addStream(const SessionStream& stream);
    /// Adds a sensor's stream; columns are "x","y","z" | "force" | "c1".."cn".
    [[nodiscard]] Result<int> addStream(const StreamInfo& stream);

    /// Adds samples. Stamps and values are kept as given, NaN too; stamps on a straight line to within 1 ns are stored
    /// as that line. Copies; allocates only until the stream's buffer has grown to a chunk.
    /// Errors: InvalidArgument for an unknown stream or values that are not samples × columns; Io.
    [[nodiscard]] Result<void> append(int stream, const SampleBlock& block);

    /// What happened: "armed", "stop", "refused", "fault" ... Committed before it returns. The value is the row's seq.
    [[nodiscard]] Result<std::int64_t> event(Instant at, std::string_view kind, const nlohmann::json& details);
    /// Records what was sent to a device. Committed with the samples.
    [[nodiscard]] Result<std::int64_t> command(Instant at, std::string_view name, const nlohmann::json& details);
    /// Records one trial and its measurements. Committed before it returns. The value is the trial's number, from 1.
    [[nodiscard]] Result<int> trial(Instant at, std::string_view condition, const nlohmann::json& measured);
    /// An oscilloscope record, compressed without loss where that helps. Committed with the samples.
    /// Errors: InvalidArgument for channels of unequal length or a trial not yet written; Io.
    [[nodiscard]] Result<std::int64_t> capture(Instant at, const Capture& capture, std::optional<int> trial = {});
    /// A measured or calibrated value. Committed with the samples.
    [[nodiscard]] Result<std::int64_t> measurement(Instant at, std::string_view name, const nlohmann::json& values);
    /// A figure, table or text of the report, in order; the writer does not look inside. Committed before it returns.
    [[nodiscard]] Result<std::int64_t> reportItem(Instant at, const nlohmann::json& item);
    /// Committed before it returns.
    [[nodiscard]] Result<std::int64_t> verdict(Instant at, std::string_view subject, std::string_view verdict,
                                               const std::vector<std::string>& reasons, const nlohmann::json& results);
    /// Committed with the samples. `level`: "info", "warning", "error".
    [[nodiscard]] Result<std::int64_t> log(Instant at, std::string_view level, std::string_view text);

    /// Commits what is pending when a second has passed since the last commit. For a caller that may append nothing
    /// for a while; append() and the others do it by themselves.
    [[nodiscard]] Result<void> commitIfDue();
    /// Commits what is pending now.
    [[nodiscard]] Result<void> flush();

    /// Writes what is pending and the end mark, and closes the file. Without it verify says "ended without closing".
    /// Every later call that writes is an InvalidArgument; a second close() does nothing.
    [[nodiscard]] Result<void> close(std::string_view reason = "finished");

    /// Why nothing is recorded any longer, once the disk refused; nothing while all is well.
    [[nodiscard]] std::optional<Error> failed() const;
    /// The hash of the last row, 64 hexadecimal digits: printed in the report. Stays available after close(). Once
    /// failed() it may belong to a row the disk refused.
    [[nodiscard]] std::string chainHead() const;
    [[nodiscard]] const std::filesystem::path& path() const noexcept;

private:
    struct State;
    explicit SessionWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
