#include "core/session/SessionRecorder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/SpscRing.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

/// How long the recorder sleeps if the ring is empty: the ring then fills for at most 10 ms.
constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr auto kDrainTimeout = std::chrono::seconds(5);

enum class RecordKind : std::uint8_t { Samples, Command, Event };

struct Note {
    std::array<RecordField, SessionRecorder::kMaxFields> fields;
    std::array<char, SessionRecorder::kMaxText> text;
    std::uint8_t fieldCount;
    std::uint8_t textSize;
};

/// Stamps first, then values, so that a record holds as many samples as possible.
struct Samples {
    std::array<double, SessionRecorder::kMaxColumns + 1> numbers;
    std::int32_t stream;
    std::uint16_t count;
    std::uint16_t columns;
};

struct Record {
    RecordKind kind;
    std::int64_t at_ns;
    const char* name;
    union {
        Note note;
        Samples samples;
    };
};

/// Returns the longest start of `text` that fits and does not end inside a UTF-8 character.
std::size_t fitting(std::string_view text) noexcept {
    if (text.size() <= SessionRecorder::kMaxText) return text.size();
    std::size_t size = SessionRecorder::kMaxText;
    while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80U) --size;
    return size;
}

Record noteOf(RecordKind kind, Instant at, const char* name, std::span<const RecordField> fields,
              std::string_view text) noexcept {
    Record record;
    record.kind = kind;
    record.at_ns = at.count();
    record.name = name;
    assert(fields.size() <= SessionRecorder::kMaxFields);
    const std::size_t count = std::min(fields.size(), SessionRecorder::kMaxFields);
    record.note = {};
    std::copy_n(fields.begin(), count, record.note.fields.begin());
    record.note.fieldCount = static_cast<std::uint8_t>(count);
    const std::size_t size = fitting(text);
    std::copy_n(text.begin(), size, record.note.text.begin());
    record.note.textSize = static_cast<std::uint8_t>(size);
    return record;
}

nlohmann::json bodyOf(const Note& note) {
    auto body = nlohmann::json::object();
    for (std::size_t i = 0; i < note.fieldCount; ++i) body[note.fields[i].key] = note.fields[i].value;
    if (note.textSize > 0) body["text"] = std::string_view(note.text.data(), note.textSize);
    return body;
}

}  // namespace

struct SessionRecorder::State {
    State(SessionWriter& into, const Settings& settings) : writer(into), inlineWrites(!settings.ownThread) {
        if (!inlineWrites) ring = std::make_unique<SpscRing<Record>>(settings.ringRecords);
    }

    SessionWriter& writer;
    const bool inlineWrites;
    std::unique_ptr<SpscRing<Record>> ring;  // only if the recorder has its own thread
    std::atomic<bool> broken{false};
    static constexpr std::chrono::nanoseconds::rep kIdle = -1;
    std::atomic<std::chrono::nanoseconds::rep> writingSince{kIdle};
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    [[nodiscard]] std::chrono::nanoseconds::rep sinceStart() const noexcept {
        return std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
    }
    SampleBlock scratch;         // for the writing side only, like the next two
    std::uint64_t reported = 0;  // how much of ring->dropped() the session has recorded
    Instant latest{0};
    std::atomic<bool> marksWait{false};

    mutable std::mutex mutex;
    std::condition_variable changed;
    std::optional<Error> error;  // guarded by mutex, like the members below
    std::vector<std::pair<Instant, std::string>> marks;
    std::uint64_t drainsWanted = 0;
    std::uint64_t drainsDone = 0;
    bool ending = false;
    std::thread thread;  // not guarded: only the constructor and the destructor touch it

    void keep(const Error& cause) {
        const std::lock_guard lock(mutex);
        if (!error) error = cause;
        broken.store(true, std::memory_order_release);
    }

    template <class T>
    void check(const Result<T>& result) {
        if (!result && !broken.load(std::memory_order_relaxed)) keep(result.error());
    }

    void take(const Record& record) noexcept {
        if (inlineWrites) {
            write(record);
        } else {
            ring->push(record);
        }
    }

    void write(const Record& record) {
        latest = Instant(record.at_ns);
        switch (record.kind) {
            case RecordKind::Samples: {
                const auto& samples = record.samples;
                const auto* values = samples.numbers.data() + samples.count;
                scratch.t_s.assign(samples.numbers.data(), values);
                scratch.values.assign(values, values + std::size_t{samples.count} * samples.columns);
                check(writer.append(samples.stream, scratch));
                break;
            }
            case RecordKind::Command:
                check(writer.command(latest, record.name, bodyOf(record.note)));
                break;
            case RecordKind::Event:
                check(writer.event(latest, record.name, bodyOf(record.note)));
                break;
        }
    }

    /// For the writing side only. The mutex is not held during the disk write.
    void writeMarks() {
        if (!marksWait.exchange(false, std::memory_order_acq_rel)) return;
        std::vector<std::pair<Instant, std::string>> waiting;
        {
            const std::lock_guard lock(mutex);
            waiting.swap(marks);
        }
        for (const auto& [at, word] : waiting) check(writer.event(at, kOperatorMarkEvent, {{"text", word}}));
    }

    void run() {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait_for(lock, kPoll, [this] { return ending || drainsWanted != drainsDone; });
            const auto wanted = drainsWanted;
            const bool last = ending;
            lock.unlock();
            writingSince.store(sinceStart(), std::memory_order_release);
            while (const auto record = ring->pop()) write(*record);
            writeMarks();
            reportDropped();
            check(wanted != drainsDone || last ? writer.flush() : writer.commitIfDue());
            writingSince.store(kIdle, std::memory_order_release);
            lock.lock();
            drainsDone = wanted;
            changed.notify_all();
            if (last) return;
        }
    }

    void reportDropped() {
        const auto dropped = ring->dropped();
        if (dropped == reported) return;
        check(writer.event(latest, "records lost",
                           {{"records", dropped - reported}, {"reason", "the disk was slower than the bench"}}));
        reported = dropped;
    }
};

SessionRecorder::SessionRecorder(SessionWriter& writer, Settings settings)
    : state_(std::make_unique<State>(writer, settings)) {
    if (settings.ownThread) state_->thread = std::thread([state = state_.get()] { state->run(); });
}

SessionRecorder::~SessionRecorder() {
    if (state_->inlineWrites) {
        state_->writeMarks();
        return;
    }
    {
        const std::lock_guard lock(state_->mutex);
        state_->ending = true;
    }
    state_->changed.notify_all();
    state_->thread.join();
}

void SessionRecorder::samples(int stream, std::size_t columns, const SampleBlock& block) noexcept {
    if (state_->inlineWrites) {  // no need to cut the block into records
        if (block.samples() > 0) state_->check(state_->writer.append(stream, block));
        return;
    }
    if (columns < 1 || columns > kMaxColumns || block.values.size() != block.samples() * columns) {
        state_->keep(
            {ErrorCode::InvalidArgument,
             fmt::format("stream {} cannot be recorded: {} columns (1 to {} are possible) and {} values for {} "
                         "samples",
                         stream, columns, kMaxColumns, block.values.size(), block.samples())});
        return;
    }
    const std::size_t fit = (kMaxColumns + 1) / (columns + 1);
    Record record;
    record.kind = RecordKind::Samples;
    record.name = nullptr;
    for (std::size_t from = 0; from < block.samples(); from += fit) {
        const std::size_t count = std::min(fit, block.samples() - from);
        record.samples = {};
        record.samples.stream = stream;
        record.samples.count = static_cast<std::uint16_t>(count);
        record.samples.columns = static_cast<std::uint16_t>(columns);
        const double at = block.t_s[from];
        record.at_ns = std::abs(at) < 1e9 ? toInstant(at).count() : 0;  // an invalid stamp gets time 0
        std::memcpy(record.samples.numbers.data(), &block.t_s[from], count * sizeof(double));
        std::memcpy(record.samples.numbers.data() + count, &block.values[from * columns],
                    count * columns * sizeof(double));
        state_->take(record);
    }
}

void SessionRecorder::frame(int stream, double t_s, std::span<const double> values) noexcept {
    if (values.empty() || values.size() > kMaxColumns) {
        state_->keep(
            {ErrorCode::InvalidArgument, fmt::format("a frame of stream {} has {} values; 1 to {} are possible", stream,
                                                     values.size(), kMaxColumns)});
        return;
    }
    Record record;
    record.kind = RecordKind::Samples;
    record.name = nullptr;
    record.at_ns = std::abs(t_s) < 1e9 ? toInstant(t_s).count() : 0;
    record.samples = {};
    record.samples.stream = stream;
    record.samples.count = 1;
    record.samples.columns = static_cast<std::uint16_t>(values.size());
    record.samples.numbers[0] = t_s;
    std::copy(values.begin(), values.end(), record.samples.numbers.begin() + 1);
    state_->take(record);
}

void SessionRecorder::command(Instant at, const char* name, std::initializer_list<RecordField> fields,
                              std::string_view text) noexcept {
    state_->take(noteOf(RecordKind::Command, at, name, {fields.begin(), fields.size()}, text));
}

void SessionRecorder::event(Instant at, const char* kind, std::initializer_list<RecordField> fields,
                            std::string_view text) noexcept {
    event(at, kind, std::span(fields.begin(), fields.size()), text);
}

void SessionRecorder::event(Instant at, const char* kind, std::span<const RecordField> fields,
                            std::string_view text) noexcept {
    state_->take(noteOf(RecordKind::Event, at, kind, fields, text));
}

void SessionRecorder::mark(Instant at, std::string word) {
    const std::lock_guard lock(state_->mutex);
    state_->marks.emplace_back(at, std::move(word));
    state_->marksWait.store(true, std::memory_order_release);
}

void SessionRecorder::writeMarks() noexcept {
    if (state_->inlineWrites) state_->writeMarks();
}

std::chrono::nanoseconds SessionRecorder::standsStillFor() const noexcept {
    const auto since = state_->writingSince.load(std::memory_order_acquire);
    return std::chrono::nanoseconds(since == State::kIdle ? 0 : state_->sinceStart() - since);
}

Result<void> SessionRecorder::drain() {
    if (state_->inlineWrites) {
        state_->writeMarks();
        state_->check(state_->writer.flush());
    } else {
        std::unique_lock lock(state_->mutex);
        const auto mine = ++state_->drainsWanted;
        state_->changed.notify_all();
        if (!state_->changed.wait_for(lock, kDrainTimeout, [&] { return state_->drainsDone >= mine; })) {
            return fail(ErrorCode::Timeout, "the session was not written within 5 s: the disk does not answer");
        }
    }
    if (auto cause = error()) return tl::unexpected<Error>(*cause);
    return {};
}

bool SessionRecorder::failed() const noexcept { return state_->broken.load(std::memory_order_acquire); }

std::optional<Error> SessionRecorder::error() const {
    const std::lock_guard lock(state_->mutex);
    return state_->error;
}

std::uint64_t SessionRecorder::dropped() const noexcept { return state_->ring ? state_->ring->dropped() : 0; }

}  // namespace tacto
