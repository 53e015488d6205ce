#include "core/session/SessionWriter.h"

#include <mutex>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "core/session/Chunk.h"
#include "core/session/Schema.h"
#include "core/session/SessionStore.h"
#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

/// Samples are promised on disk within a second; this leaves the rest of the second for the disk.
constexpr Instant kCommitEvery = std::chrono::milliseconds(800);

/// A chunk ends once it has this many values (512 kB), so that a fast stream does not fill memory for a second.
constexpr std::size_t kChunkValues = 65'536;

struct StreamBuffer {
    std::size_t columns;
    SampleBlock pending;
    std::int64_t nextIndex = 0;
    std::uint64_t nextSample = 0;
};

}  // namespace

struct SessionWriter::State {
    State(std::filesystem::path where, const Clock& time, SessionStore made)
        : path(std::move(where)), clock(time), store(std::move(made)), lastCommit(time.now()) {
        store.setBackground(time.isVirtual() ? SessionStore::Durability::ProcessEnd
                                             : SessionStore::Durability::PowerLoss);
    }

    const std::filesystem::path path;
    const Clock& clock;
    mutable std::mutex mutex;
    SessionStore store;  // guarded by mutex, like the members below
    std::vector<StreamBuffer> streams;
    int trials = 0;
    Instant lastCommit;
    bool closed = false;
    std::optional<Error> failed;
    std::shared_ptr<SessionListener> listener;  // null: none

    [[nodiscard]] Result<void> open() const {
        if (failed) return tl::unexpected<Error>(*failed);
        if (closed) return invalid("session {} is closed", path.string());
        return {};
    }

    /// Returns the store's result; an error ends the recording for good.
    template <class T>
    [[nodiscard]] Result<T> kept(Result<T> result) {
        if (!result) {
            failed = Error{ErrorCode::Io, fmt::format("session {} cannot be written, recording has ended: {}",
                                                      path.string(), result.error().message)};
            return tl::unexpected<Error>(*failed);
        }
        return result;
    }

    [[nodiscard]] Result<std::int64_t> addNow(const char* kind, Instant at, std::string_view name,
                                              const nlohmann::json& body) {
        if (auto ready = open(); !ready) return failure(ready);
        return kept(store.addNow(kind, at, name, dumpJson(body)));
    }

    [[nodiscard]] Result<std::int64_t> add(const char* kind, Instant at, std::string_view name,
                                           const nlohmann::json& body) {
        if (auto ready = open(); !ready) return failure(ready);
        auto row = kept(store.add(kind, at, name, dumpJson(body)));
        if (!row) return row;
        if (auto committed = commitIfDue(); !committed) return failure(committed);
        return row;
    }

    void queueChunk(std::size_t index) {
        auto& stream = streams[index];
        const auto samples = stream.pending.samples();
        if (samples == 0) return;
        store.queueChunk(clock.now(),
                         {static_cast<int>(index) + 1, stream.nextIndex, stream.nextSample, samples, {}, 0, {}},
                         stream.pending);
        ++stream.nextIndex;
        stream.nextSample += samples;
    }

    void queueChunks() {
        for (std::size_t i = 0; i < streams.size(); ++i) queueChunk(i);
        lastCommit = clock.now();
    }

    [[nodiscard]] Result<void> commit() {
        queueChunks();
        return kept(store.commit());
    }

    /// Writes all pending rows, then the end mark.
    [[nodiscard]] Result<void> end(std::string_view reason) {
        if (failed) return tl::unexpected<Error>(*failed);
        if (auto done = commit(); !done) return done;
        const auto counts = dumpJson({{"rows", store.rows() + 1}, {"trials", trials}});
        auto row = kept(store.addNow(kind::kEnd, clock.now(), reason, counts));
        if (!row) return failure(row);
        return kept(store.close());
    }

    [[nodiscard]] Result<void> commitIfDue() {
        if (clock.now() - lastCommit < kCommitEvery) return kept(store.collect());
        queueChunks();
        return kept(store.commitInBackground());
    }
};

SessionWriter::SessionWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
SessionWriter::~SessionWriter() { static_cast<void>(close("left open by the program")); }

Result<std::unique_ptr<SessionWriter>> SessionWriter::create(const std::filesystem::path& path, SessionAbout about,
                                                             const Clock& clock, std::shared_ptr<const RowSeal> seal) {
    if (about.wallStart.empty()) {
        about.wallStart = wallTimeUtc();
        about.wallStartAt = clock.now();
    }
    if (about.profileSha256.empty()) about.profileSha256 = sha256Hex(about.profileJson);
    about.virtualClock = clock.isVirtual();
    const int version = seal != nullptr ? kSealedVersion : kPackedVersion;
    auto store = SessionStore::create(path, clock.now(), dumpJson(toJson(about)), version, std::move(seal));
    if (!store) return failure(store);
    return std::unique_ptr<SessionWriter>(new SessionWriter(std::make_unique<State>(path, clock, std::move(*store))));
}

void SessionWriter::listen(std::shared_ptr<SessionListener> listener) {
    const std::lock_guard lock(state_->mutex);
    state_->listener.swap(listener);
}

Result<int> SessionWriter::addStream(const SessionStream& stream) {
    const std::lock_guard lock(state_->mutex);
    if (stream.columns.empty()) {
        return invalid("stream '{}' has no columns; at least one is needed", stream.name);
    }
    auto row = state_->add(kind::kStream, state_->clock.now(), stream.name, toJson(stream));
    if (!row) return failure(row);
    state_->streams.push_back({stream.columns.size(), {}});
    const auto id = static_cast<int>(state_->streams.size());
    if (state_->listener) state_->listener->onStream(id, stream);
    return id;
}

Result<int> SessionWriter::addStream(const StreamInfo& info) {
    SessionStream stream{info.name, std::string(nameOf(info.kind)), std::string(symbolOf(info.unit)), {}, info.rate_hz};
    for (std::size_t c = 0; c < info.channels; ++c) {
        switch (info.kind) {
            case StreamKind::Acceleration:
                stream.columns.push_back(c < 3 ? std::string(1, "xyz"[c]) : fmt::format("a{}", c + 1));
                break;
            case StreamKind::Force:
                stream.columns.push_back(c == 0 ? "force" : fmt::format("force{}", c + 1));
                break;
            case StreamKind::Taxels:
                stream.columns.push_back(fmt::format("c{}", c + 1));
                break;
        }
    }
    return addStream(stream);
}

Result<void> SessionWriter::append(int stream, const SampleBlock& block) {
    const std::lock_guard lock(state_->mutex);
    if (auto ready = state_->open(); !ready) return ready;
    if (stream < 1 || static_cast<std::size_t>(stream) > state_->streams.size()) {
        return invalid("there is no stream {}; the session has {}", stream, state_->streams.size());
    }
    const auto index = static_cast<std::size_t>(stream) - 1;
    auto& buffer = state_->streams[index];
    if (block.values.size() != block.samples() * buffer.columns) {
        return invalid("stream {} got {} values for {} samples of {} columns", stream, block.values.size(),
                       block.samples(), buffer.columns);
    }
    auto& pending = buffer.pending;
    pending.t_s.insert(pending.t_s.end(), block.t_s.begin(), block.t_s.end());
    pending.values.insert(pending.values.end(), block.values.begin(), block.values.end());
    if (state_->listener) state_->listener->onSamples(stream, block);
    if (pending.values.size() < kChunkValues) return state_->commitIfDue();
    state_->queueChunk(index);
    if (state_->clock.now() - state_->lastCommit >= kCommitEvery) return state_->commitIfDue();
    return state_->kept(state_->store.commitInBackground());
}

Result<std::int64_t> SessionWriter::event(Instant at, std::string_view kind, const nlohmann::json& details) {
    const std::lock_guard lock(state_->mutex);
    auto row = state_->addNow(kind::kEvent, at, kind, details);
    if (row && state_->listener) state_->listener->onEvent({*row, at, std::string(kind), details});
    return row;
}

Result<std::int64_t> SessionWriter::command(Instant at, std::string_view name, const nlohmann::json& details) {
    const std::lock_guard lock(state_->mutex);
    auto row = state_->add(kind::kCommand, at, name, details);
    if (row && state_->listener) state_->listener->onCommand({*row, at, std::string(name), details});
    return row;
}

Result<int> SessionWriter::trial(Instant at, std::string_view condition, const nlohmann::json& measured) {
    const std::lock_guard lock(state_->mutex);
    const int number = state_->trials + 1;
    auto row = state_->addNow(kind::kTrial, at, condition, {{"number", number}, {"measured", measured}});
    if (!row) return failure(row);
    if (state_->listener) state_->listener->onTrial({*row, number, at, std::string(condition), measured});
    return state_->trials = number;
}

Result<std::int64_t> SessionWriter::capture(Instant at, const Capture& capture, std::optional<int> trial) {
    for (const auto& channel : capture.channels) {
        if (channel.samples.size() != capture.samples()) {
            return invalid("capture channel '{}' has {} samples, '{}' has {}", channel.name, channel.samples.size(),
                           capture.channels.front().name, capture.samples());
        }
    }
    // Compressed and hashed before the lock, since this takes milliseconds and uses nothing of the session.
    const auto packed = packSamples(capture);
    const std::span<const std::byte> parts[] = {packed.data};
    const auto digest = bulkDigest(parts);
    auto body = describePacked(capture, packed);
    body["crc32"] = crc32(parts);

    const std::lock_guard lock(state_->mutex);
    if (auto ready = state_->open(); !ready) return failure(ready);
    if (trial) {
        if (*trial < 1 || *trial > state_->trials) {
            return invalid("a capture names trial {}; the session has {}", *trial, state_->trials);
        }
        body["trial"] = *trial;
    }
    auto row = state_->kept(state_->store.addCapture(at, dumpJson(body), digest, packed.data));
    if (!row) return row;
    if (auto committed = state_->commitIfDue(); !committed) return failure(committed);
    return row;
}

Result<std::int64_t> SessionWriter::measurement(Instant at, std::string_view name, const nlohmann::json& values) {
    const std::lock_guard lock(state_->mutex);
    return state_->add(kind::kMeasurement, at, name, values);
}

Result<std::int64_t> SessionWriter::reportItem(Instant at, const nlohmann::json& item) {
    const std::lock_guard lock(state_->mutex);
    return state_->addNow(kind::kReport, at, textOr(item, "kind"), item);
}

Result<std::int64_t> SessionWriter::verdict(Instant at, std::string_view subject, std::string_view verdict,
                                            const std::vector<std::string>& reasons, const nlohmann::json& results) {
    const std::lock_guard lock(state_->mutex);
    return state_->addNow(kind::kVerdict, at, subject,
                          {{"verdict", verdict}, {"reasons", reasons}, {"results", results}});
}

Result<std::int64_t> SessionWriter::log(Instant at, std::string_view level, std::string_view text) {
    const std::lock_guard lock(state_->mutex);
    return state_->add(kind::kLog, at, level, {{"text", text}});
}

Result<void> SessionWriter::commitIfDue() {
    const std::lock_guard lock(state_->mutex);
    if (auto ready = state_->open(); !ready) return ready;
    return state_->commitIfDue();
}

Result<void> SessionWriter::flush() {
    const std::lock_guard lock(state_->mutex);
    if (auto ready = state_->open(); !ready) return ready;
    return state_->commit();
}

Result<void> SessionWriter::close(std::string_view reason) {
    const std::lock_guard lock(state_->mutex);
    if (state_->closed) return {};
    state_->closed = true;
    auto done = state_->end(reason);
    if (!done) state_->store.abandon();
    return done;
}

std::optional<Error> SessionWriter::failed() const {
    const std::lock_guard lock(state_->mutex);
    if (!state_->failed) static_cast<void>(state_->kept(state_->store.collect()));
    return state_->failed;
}

std::string SessionWriter::chainHead() const {
    const std::lock_guard lock(state_->mutex);
    if (!state_->failed) static_cast<void>(state_->kept(state_->store.settle()));
    return hexText(state_->store.head());
}

const std::filesystem::path& SessionWriter::path() const noexcept { return state_->path; }

}  // namespace tacto
