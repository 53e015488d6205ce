// SessionWriter.h - writes a session file (*.tacto): one append-only SQLite log with its rows on a hash chain.
//
// Promise (hazard H8): once event(), trial(), verdict() or reportItem() has returned a value, the row survives kill -9
// and power loss. Samples, commands, captures, measurements and log lines are committed at least once a second of the
// session's clock, and together with every row named before; another thread writes them to disk. On a virtual clock the
// commits of each second survive kill -9, but survive power loss only after the next acknowledged row. Nothing is lost
// silently: the call that meets a disk error and every later call return it, and failed() reports it.
//
// With a virtual clock the same calls write the same rows and chunks on every machine.
//
// Thread-safety: any thread; a mutex lets one call in at a time. Calls may block for a disk write: a control loop on
// the steady clock uses SessionRecorder instead.
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
#include "core/session/SessionListener.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionWriter {
public:
    /// Creates the file with `about` as its first row. A crash meanwhile leaves either no session or a valid session.
    /// `clock` is the session's clock and must outlive the writer. With a `seal`, the contents of rows are stored
    /// sealed (SealedRow.h).
    /// Errors: InvalidArgument if `path` exists (never overwritten); Io naming the path and the reason.
    [[nodiscard]] static Result<std::unique_ptr<SessionWriter>> create(const std::filesystem::path& path,
                                                                       SessionAbout about, const Clock& clock,
                                                                       std::shared_ptr<const RowSeal> seal = nullptr);
    /// Closes the file if close() was not called.
    ~SessionWriter();
    SessionWriter(const SessionWriter&) = delete;
    SessionWriter& operator=(const SessionWriter&) = delete;

    /// Also tells `listener` of streams, samples, commands, events and trials from now on; null ends this. On return
    /// the earlier listener is told nothing more.
    void listen(std::shared_ptr<SessionListener> listener);

    /// Adds a stream and returns its id for append(). Errors: InvalidArgument without columns; Io.
    [[nodiscard]] Result<int> addStream(const SessionStream& stream);
    /// Adds a sensor's stream. Its columns are "x","y","z" | "force" | "c1".."cn".
    [[nodiscard]] Result<int> addStream(const StreamInfo& stream);

    /// Adds samples. Stores stamps and values unchanged, also NaN; stamps within 1 ns of a straight line are stored as
    /// that line. Copies the samples; allocates only until the stream's buffer has the size of a chunk.
    /// Errors: InvalidArgument for an unknown stream or a number of values other than samples × columns; Io.
    [[nodiscard]] Result<void> append(int stream, const SampleBlock& block);

    /// Records an event: "armed", "stop", "refused", "fault" ... Commits before it returns the row's seq.
    [[nodiscard]] Result<std::int64_t> event(Instant at, std::string_view kind, const nlohmann::json& details);
    /// Records a command that was sent to a device. Committed with the samples.
    [[nodiscard]] Result<std::int64_t> command(Instant at, std::string_view name, const nlohmann::json& details);
    /// Records one trial and its measurements. Commits before it returns the trial's number, from 1.
    [[nodiscard]] Result<int> trial(Instant at, std::string_view condition, const nlohmann::json& measured);
    /// Records an oscilloscope capture, losslessly compressed if that saves space. Committed with the samples.
    /// Errors: InvalidArgument for channels of unequal length or a trial that is not written yet; Io.
    [[nodiscard]] Result<std::int64_t> capture(Instant at, const Capture& capture, std::optional<int> trial = {});
    /// Records a measured or calibrated value. Committed with the samples.
    [[nodiscard]] Result<std::int64_t> measurement(Instant at, std::string_view name, const nlohmann::json& values);
    /// Adds a figure, table or text to the report; the writer does not read its content. Commits before it returns.
    [[nodiscard]] Result<std::int64_t> reportItem(Instant at, const nlohmann::json& item);
    /// Records a verdict. Commits before it returns.
    [[nodiscard]] Result<std::int64_t> verdict(Instant at, std::string_view subject, std::string_view verdict,
                                               const std::vector<std::string>& reasons, const nlohmann::json& results);
    /// Records a log line. Committed with the samples. `level`: "info", "warning", "error".
    [[nodiscard]] Result<std::int64_t> log(Instant at, std::string_view level, std::string_view text);

    /// Commits pending rows if a second has passed since the last commit. For a caller that may add nothing for a
    /// while; append() and the other calls do this themselves.
    [[nodiscard]] Result<void> commitIfDue();
    /// Commits pending rows now.
    [[nodiscard]] Result<void> flush();

    /// Writes pending rows and the end mark, and closes the file. Without an end mark verify says "ended without
    /// closing". Every later write is an InvalidArgument; a second close() does nothing.
    [[nodiscard]] Result<void> close(std::string_view reason = "finished");

    /// The error of the disk that ended the recording; nothing as long as there is none.
    [[nodiscard]] std::optional<Error> failed() const;
    /// The hash of the last row, 64 hexadecimal digits, as printed in the report. Also valid after close(). After an
    /// error the row may be one that the disk refused.
    [[nodiscard]] std::string chainHead() const;
    [[nodiscard]] const std::filesystem::path& path() const noexcept;

private:
    struct State;
    explicit SessionWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
