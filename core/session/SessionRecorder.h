// SessionRecorder.h - records for a control loop, which never has to wait for a disk.
//
// On the steady clock each call copies fixed-size records into a ring, without blocking or allocating, and the
// recorder's own thread writes them to the session. On a virtual clock the same calls write at once, on the caller's
// thread, so that the same seed gives the same rows.
// When the ring overflows (the disk stood still for longer than it holds) the oldest records are lost; the loss is
// counted, written to the session as an event, and shown by dropped().
//
// The operator's marks go past the ring, so that the control loop stays its one caller, and wait for no disk either.
//
// Thread-safety: samples(), command(), event(), writeMarks() have one caller, the control loop; the rest any thread.
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

/// A named value of a command or event. `key` must live forever: a string literal.
struct RecordField {
    const char* key;
    double value;  ///< NaN is written as null
};

class SessionRecorder {
public:
    static constexpr std::size_t kMaxFields = 16;   ///< more are an error in debug and left out in release
    static constexpr std::size_t kMaxText = 200;    ///< bytes; longer text is cut at a character
    static constexpr std::size_t kMaxColumns = 63;  ///< columns of a stream recorded here

    struct Settings {
        bool ownThread = true;           ///< false: write at once, on the caller's thread (virtual clock)
        std::size_t ringRecords = 8192;  ///< about 0.5 kB each
    };
    /// `writer` outlives the recorder.
    SessionRecorder(SessionWriter& writer, Settings settings);
    ~SessionRecorder();  ///< drains the ring and joins the thread
    SessionRecorder(const SessionRecorder&) = delete;
    SessionRecorder& operator=(const SessionRecorder&) = delete;

    /// Adds samples to a stream of `columns` columns (an id from SessionWriter::addStream). `columns` ≤ kMaxColumns.
    void samples(int stream, std::size_t columns, const SampleBlock& block) noexcept;
    /// Records one sample with its columns: a frame of the roughness chain, a line of telemetry.
    void frame(int stream, double t_s, std::span<const double> values) noexcept;
    /// `name` must live forever. Written with the samples.
    void command(Instant at, const char* name, std::initializer_list<RecordField> fields,
                 std::string_view text = {}) noexcept;
    /// `kind` must live forever. On its own thread the recorder commits it at once; wait for that with drain().
    void event(Instant at, const char* kind, std::initializer_list<RecordField> fields,
               std::string_view text = {}) noexcept;
    void event(Instant at, const char* kind, std::span<const RecordField> fields, std::string_view text) noexcept;

    /// The operator marked the moment `at` with a word. Never waits for the disk. Written by the recorder's own thread
    /// or, without one, by the next writeMarks(), drain() or the end.
    void mark(Instant at, std::string word);
    /// Writes the marks that wait, for a recorder without a thread of its own.
    void writeMarks() noexcept;

    /// Waits until everything recorded before is committed. Errors: as SessionWriter::failed(); Timeout after 5 s.
    [[nodiscard]] Result<void> drain();
    /// Whether recording has ended by the writer's first error. Never blocks; for the control loop.
    [[nodiscard]] bool failed() const noexcept;
    [[nodiscard]] std::optional<Error> error() const;
    /// How long the present writing has taken so far: how long the disk has stood still. 0 between two writings and
    /// where the caller itself writes. Never blocks; for the control loop.
    [[nodiscard]] std::chrono::nanoseconds standsStillFor() const noexcept;
    /// Records lost to overflow so far.
    [[nodiscard]] std::uint64_t dropped() const noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tacto
