// SessionRecorder.h - records the data of a control loop, which never has to wait for a disk.
//
// On the steady clock each call copies fixed-size records to a ring, without blocking or allocating; the recorder's own
// thread writes them to the session. On a virtual clock the same calls write at once, on the caller's thread, so that
// the same seed gives the same rows.
// If the disk stalls for too long, the ring overflows and its oldest records are lost; the loss is counted, recorded as
// an event, and shown by dropped().
//
// The operator's marks bypass the ring, so that the control loop stays its only caller, and never wait for the disk.
//
// Thread-safety: samples(), command(), event(), writeMarks(): one caller, the control loop; the others: any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/base/Units.h"

namespace tacto {

class SessionWriter;

/// A named value of a command or event. `key` must stay valid forever, like a string literal.
struct RecordField {
    const char* key;
    double value;  ///< NaN is written as null
};

class SessionRecorder {
public:
    static constexpr std::size_t kMaxFields = 16;   ///< more are an error in debug and left out in release
    static constexpr std::size_t kMaxText = 200;    ///< bytes; longer text is cut between two characters
    static constexpr std::size_t kMaxColumns = 63;  ///< columns of a stream recorded here

    struct Settings {
        bool ownThread = true;           ///< false: write at once, on the caller's thread (virtual clock)
        std::size_t ringRecords = 8192;  ///< about 0.5 kB each
    };
    /// `writer` must outlive the recorder.
    SessionRecorder(SessionWriter& writer, Settings settings);
    ~SessionRecorder();  ///< drains the ring and joins the thread
    SessionRecorder(const SessionRecorder&) = delete;
    SessionRecorder& operator=(const SessionRecorder&) = delete;

    /// Adds samples to the stream with the id `stream` (SessionWriter::addStream()); `columns` ≤ kMaxColumns.
    void samples(int stream, std::size_t columns, const SampleBlock& block) noexcept;
    /// Records one sample of several columns, such as a frame of the roughness chain or a line of telemetry.
    void frame(int stream, double t_s, std::span<const double> values) noexcept;
    /// Records a command together with the samples. `name` must stay valid forever.
    void command(Instant at, const char* name, std::initializer_list<RecordField> fields,
                 std::string_view text = {}) noexcept;
    /// `kind` must stay valid forever. The recorder's own thread commits an event at once; drain() waits for it.
    void event(Instant at, const char* kind, std::initializer_list<RecordField> fields,
               std::string_view text = {}) noexcept;
    void event(Instant at, const char* kind, std::span<const RecordField> fields, std::string_view text) noexcept;

    /// Records that the operator marked the moment `at` with a word. Never waits for the disk: the recorder's own
    /// thread writes the mark or, without such a thread, the next writeMarks(), drain() or the destructor.
    void mark(Instant at, std::string word);
    /// Writes waiting marks; for a recorder without a thread of its own.
    void writeMarks() noexcept;

    /// Waits until everything recorded so far is committed. Errors: as SessionWriter::failed(); Timeout after 5 s.
    [[nodiscard]] Result<void> drain();
    /// Whether an error of the writer has ended the recording. Never blocks; for the control loop.
    [[nodiscard]] bool failed() const noexcept;
    [[nodiscard]] std::optional<Error> error() const;
    /// How long the present write has taken so far, that is, how long the disk has stalled. 0 between two writes, or if
    /// the caller itself writes. Never blocks; for the control loop.
    [[nodiscard]] std::chrono::nanoseconds standsStillFor() const noexcept;
    /// Number of records lost so far because the ring overflowed.
    [[nodiscard]] std::uint64_t dropped() const noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tacto
