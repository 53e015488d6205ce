#include "core/exchange/lsl/LslStreams.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/ProgramVersion.h"
#include "core/exchange/ExportMoments.h"
#include "core/exchange/ExportTables.h"
#include "core/exchange/xdf/XdfNames.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

using namespace std::chrono_literals;

constexpr auto kOpens = 5s;              // most that begin() waits for the library
constexpr auto kEnds = 3s;               // most that end() waits for it
constexpr auto kLastSamples = 200ms;     // for recorders to take what was sent last
constexpr std::int32_t kBuffered = 360;  // hundreds of samples that liblsl keeps for a recorder that is slow

struct Frame {
    double t_s;
    std::vector<double> values;
};
struct Marker {
    double t_s;
    std::string text;
};
struct Row {
    SessionRow row;
    bool isCommand;
};
using Heard = std::variant<Frame, Marker, Row>;

/// A thread that may never return from a library.
class LibraryThread {
public:
    template <class Work>
    void start(Work&& work) {
        std::packaged_task<void()> task(std::forward<Work>(work));
        ended_ = task.get_future();
        thread_ = std::thread(std::move(task));
    }
    /// Returns false if it is left to itself.
    bool end(std::chrono::steady_clock::time_point until) {
        if (!thread_.joinable()) return true;
        const bool ended = ended_.wait_until(until) == std::future_status::ready;
        ended ? thread_.join() : thread_.detach();
        ended_ = {};  // it keeps the work, which keeps the owner of this
        return ended;
    }

private:
    std::future<void> ended_;
    std::thread thread_;
};

/// An outlet and how its samples fared.
class Outlet {
public:
    struct Channel {
        std::string label, unit, type;
    };
    struct About {
        std::string session, program, id;
        bool simulated;
    };
    Outlet(const LslLibrary& library, LslTally& tally) : library_(library), tally_(tally) {}
    ~Outlet() {
        if (outlet_ != nullptr) library_.destroyOutlet(outlet_);
    }
    Outlet(const Outlet&) = delete;
    Outlet& operator=(const Outlet&) = delete;

    /// `what`: "frames".
    [[nodiscard]] Result<void> open(const std::string& what, const char* type, std::int32_t format,
                                    const std::vector<Channel>& channels, const About& about) {
        const auto name = "Tactoscope-" + what;
        const auto id = fmt::format("tactoscope-{}-{}-{}", about.session, what, about.id);
        auto* info =
            library_.createInfo(name.c_str(), type, static_cast<std::int32_t>(channels.size()), 0, format, id.c_str());
        if (info == nullptr) return refused(name);
        auto* desc = library_.description(info);
        const auto say = [&](LslXml* to, const char* key, const std::string& value) {
            static_cast<void>(library_.appendValue(to, key, value.c_str()));
        };
        say(desc, xdf::kProgram, about.program);
        say(desc, "session", about.session);
        say(desc, xdf::kSimulated, about.simulated ? "1" : "0");
        auto* list = library_.appendChild(desc, "channels");
        for (const auto& channel : channels) {
            auto* node = library_.appendChild(list, "channel");
            say(node, "label", channel.label);
            say(node, "unit", channel.unit);
            say(node, "type", channel.type);
        }
        outlet_ = library_.createOutlet(info, 0, kBuffered);
        library_.destroyInfo(info);
        return outlet_ != nullptr ? Result<void>() : refused(name);
    }
    [[nodiscard]] bool isOpen() const noexcept { return outlet_ != nullptr; }
    [[nodiscard]] bool isHeard() const { return isOpen() && library_.hasConsumers(outlet_) != 0; }

    void push(const std::vector<double>& values, double stamp_s, std::uint64_t& sent) {
        count(library_.pushNumbers(outlet_, values.data(), stamp_s, 1), sent);
    }
    void push(const std::string& text, double stamp_s, std::uint64_t& sent) {
        const char* data = text.data();
        const auto length = static_cast<std::uint32_t>(text.size());
        count(library_.pushText(outlet_, &data, &length, stamp_s, 1), sent);
    }

private:
    [[nodiscard]] Result<void> refused(const std::string& name) const {
        const char* why = library_.lastError();
        return fail(ErrorCode::Device,
                    "liblsl refuses the stream {} ({}), so nothing is put out; without LSL it can be", name,
                    why != nullptr && *why != '\0' ? why : "it does not say why");
    }
    void count(std::int32_t error, std::uint64_t& sent) {
        if (error != 0) {
            ++tally_.refused;
            return;
        }
        ++sent;
        if (!isHeard()) ++tally_.unheard;
    }

    const LslLibrary& library_;
    LslTally& tally_;
    LslOutlet* outlet_ = nullptr;
};

std::string randomId() {
    std::random_device random;
    return fmt::format("{:08x}{:08x}", random(), random());
}

}  // namespace

struct LslStreams::State {
    LslOrder order;
    std::shared_ptr<const LslLibrary> library;
    bool markersOnly = false;

    // Set by begin() before the threads start.
    std::shared_ptr<const Clock> clock;
    Outlet::About about;
    bool trainsSimulated = false, hasTrains = false;

    std::promise<Result<LslClock>> opened;  // set by the first thread
    LibraryThread sending, noting;

    // Used only by the session that is heard, and by begin(), after which there are no more streams.
    int frameStream = 0;  // 0: there is none
    std::vector<ExportChannel> frameChannels;

    std::mutex mutex;
    std::condition_variable changed;
    // Guarded by mutex, held only for moments:
    std::deque<Heard> waiting;
    std::uint64_t dropped = 0;
    bool hears = false, ending = false;
    LslTally tally;  // as the threads have left it

    std::mutex noteMutex;
    SessionWriter* writer = nullptr;  // guarded by noteMutex, which is held while a note is written

    void hear(Heard heard) {
        const std::scoped_lock lock(mutex);
        if (!hears) return;
        if (waiting.size() >= kMaxWaiting) {
            ++dropped;
            return;
        }
        waiting.push_back(std::move(heard));
        if (waiting.size() == 1) changed.notify_one();
    }
    /// What a listener does must not throw: without memory for it, a sample is one that is dropped.
    template <class Make>
    void hearIf(bool wanted, Make&& make) noexcept {
        if (!wanted) return;
        try {
            if (std::optional<Heard> heard = make()) hear(*std::move(heard));
        } catch (const std::exception&) {
            const std::scoped_lock lock(mutex);
            ++dropped;
        }
    }
    [[nodiscard]] bool isEnding() {
        const std::scoped_lock lock(mutex);
        return ending;
    }

    [[nodiscard]] Result<void> open(Outlet& markers, Outlet& frames, Outlet& trains) const {
        if (!order.outlets) return {};
        const std::vector<Outlet::Channel> text{{"markers", "", xdf::kMarkers}};
        if (auto made = markers.open("markers", xdf::kMarkers, LslLibrary::kString, text, about); !made) return made;
        if (markersOnly) return {};
        std::vector<Outlet::Channel> channels;
        for (const auto& each : frameChannels) channels.push_back({each.name, each.unit, xdf::typeOf(each.unit)});
        if (!channels.empty())
            if (auto made = frames.open("frames", "frames", LslLibrary::kDouble64, channels, about); !made) return made;
        if (!hasTrains) return {};
        channels.clear();
        for (const auto& each : numberChannels(trainTable()))
            channels.push_back({each.name, each.unit, xdf::kOfTrains});
        return trains.open("trains", "trains", LslLibrary::kDouble64, channels, about);
    }

    void send() {
        LslTally sent;
        {
            Outlet markers(*library, sent), frames(*library, sent), trains(*library, sent);
            auto matched = LslClock::match(*library, *clock);
            if (matched)
                if (auto made = open(markers, frames, trains); !made) matched = failure(made);
            opened.set_value(matched);
            if (!matched) return;
            TrainJoin join({}, trainsSimulated);
            std::vector<ExportCell> cells;
            const auto pushTrain = [&](const ExportTrain& train) -> Result<void> {
                trainCells(train, cells);
                const double stamp_s = matched->stampOf(train.time_s);
                if (trains.isOpen()) trains.push(numbersIn(cells), stamp_s, sent.trains);
                markers.push(wordsFor(train), stamp_s, sent.markers);
                return {};
            };
            while (const auto next = take()) {
                keep(sent);
                if (const auto* frame = std::get_if<Frame>(&*next))
                    frames.push(frame->values, matched->stampOf(frame->t_s), sent.frames);
                else if (const auto* marker = std::get_if<Marker>(&*next))
                    markers.push(marker->text, matched->stampOf(marker->t_s), sent.markers);
                else if (const auto& row = std::get<Row>(*next); row.isCommand)
                    static_cast<void>(join.take(row.row, pushTrain));
                else
                    static_cast<void>(join.refuse(row.row, pushTrain));
            }
            static_cast<void>(join.end(pushTrain));
            if (markers.isHeard() || frames.isHeard() || trains.isHeard()) std::this_thread::sleep_for(kLastSamples);
        }
        keep(sent);
    }
    /// What was sent is known also where the library does not return from the next call.
    void keep(LslTally sent) {
        const std::scoped_lock lock(mutex);
        sent.notes = std::move(tally.notes);
        tally = std::move(sent);
    }

    /// Waits for something to send; nothing at the end.
    std::optional<Heard> take() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return ending || !waiting.empty(); });
        if (waiting.empty()) return std::nullopt;
        std::optional<Heard> taken(std::move(waiting.front()));
        waiting.pop_front();
        return taken;
    }

    void note(const LslClock& matched) {
        auto notes = LslNotes::run(
            *library, order.markers, matched, *clock, [this] { return isEnding(); },
            [this](const LslNote& note) {
                nlohmann::json body{{"text", note.text}, {"stream", order.markers}};
                if (!note.stamped) body["stamp"] = "of no use: the time is when it came";
                if (note.shortened) body["shortened"] = true;
                {
                    const std::scoped_lock lock(mutex);
                    ++tally.notes.taken;
                }
                const std::scoped_lock lock(noteMutex);
                if (writer != nullptr) static_cast<void>(writer->event(note.at, kOperatorMarkEvent, body));
            });
        const std::scoped_lock lock(mutex);
        tally.notes = std::move(notes);
    }
};

nlohmann::json toJson(const LslTally& tally) {
    return {{"markers", tally.markers},
            {"frames", tally.frames},
            {"trains", tally.trains},
            {"unheard", tally.unheard},
            {"dropped", tally.dropped},
            {"refused", tally.refused},
            {"unsent", tally.unsent},
            {"notes",
             {{"taken", tally.notes.taken},
              {"left", tally.notes.left},
              {"unstamped", tally.notes.unstamped},
              {"shortened", tally.notes.shortened},
              {"streams", tally.notes.streams},
              {"trouble", tally.notes.trouble}}},
            {"hung", tally.hung}};
}

std::string lslSentence(const LslTally& tally) {
    const auto& order = tally.order;
    std::string said = "LSL: ";
    if (order.outlets) {
        said += fmt::format("{} markers, {} frames and {} trains were sent", tally.markers, tally.frames, tally.trains);
        if (tally.unheard > 0) said += fmt::format("; {} of them while no program recorded them", tally.unheard);
        if (tally.dropped > 0) said += fmt::format("; {} were dropped, as liblsl was slower", tally.dropped);
        if (tally.refused > 0) said += fmt::format("; {} were refused by liblsl", tally.refused);
        if (tally.unsent > 0) said += fmt::format("; {} were not sent", tally.unsent);
        if (tally.unheard + tally.dropped + tally.refused == 0 && !tally.hung) said += ", and nothing was lost";
        said += order.markers.empty() ? "" : "; ";
    }
    if (!order.markers.empty()) {
        const auto& notes = tally.notes;
        said += fmt::format("{} notes came from \"{}\"", notes.taken, order.markers);
        if (notes.streams == 0 && !tally.hung)
            said += notes.trouble.empty() ? ", which was never found" : "; " + notes.trouble;
        if (notes.left > 0)
            said +=
                fmt::format("; {} were left out (empty, or more than {} a second)", notes.left, LslNotes::kPerSecond);
        if (notes.shortened > 0) said += fmt::format("; {} were shortened", notes.shortened);
        if (notes.unstamped > 0) said += fmt::format("; {} have the time at which they came", notes.unstamped);
    }
    if (tally.hung) said += "; liblsl did not return at the end";
    return said + ".";
}

LslStreams::LslStreams(std::shared_ptr<State> state) : state_(std::move(state)) {}
LslStreams::~LslStreams() { static_cast<void>(end()); }

Result<std::shared_ptr<LslStreams>> LslStreams::prepare(LslOrder order, bool markersOnly) {
    if (!order.markers.empty())
        if (auto named = LslNotes::checkName(order.markers); !named) return failure(named);
    auto library = LslLibrary::load();
    if (!library) return failure(library);
    auto state = std::make_shared<State>();
    state->order = std::move(order);
    state->library = std::move(*library);
    state->markersOnly = markersOnly;
    return std::shared_ptr<LslStreams>(new LslStreams(std::move(state)));
}

Result<void> LslStreams::begin(SessionWriter& session, const SessionAbout& about, std::string_view name,
                               std::shared_ptr<const Clock> clock) {
    auto& state = *state_;
    state.clock = std::move(clock);
    state.about = {std::string(name), fmt::format("Tactoscope {}", programVersion().version), randomId(),
                   about.simulated};
    const auto kPutOut = {Role::Stimulator, Role::Massager};
    state.hasTrains = std::ranges::any_of(about.devices, [&](const SessionDevice& device) {
        return std::ranges::any_of(kPutOut, [&](Role role) { return device.is(role); });
    });
    state.trainsSimulated = simulatedOf(about, kPutOut, about.simulated);
    auto opened = state.opened.get_future();
    state.sending.start([state = state_] { state->send(); });
    if (opened.wait_for(kOpens) != std::future_status::ready)
        return fail(ErrorCode::Timeout, "liblsl ({}) has not opened its streams within 5 s, so nothing is put out",
                    state.library->file.string());
    auto matched = opened.get();
    if (!matched) return failure(matched);
    {
        const std::scoped_lock lock(state.mutex);
        state.hears = state.order.outlets;
    }
    if (state.order.markers.empty()) return {};
    {
        const std::scoped_lock lock(state.noteMutex);
        state.writer = &session;
    }
    state.noting.start([state = state_, matched = *matched] { state->note(matched); });
    return {};
}

LslTally LslStreams::end() {
    auto& state = *state_;
    {
        const std::scoped_lock lock(state.noteMutex);
        state.writer = nullptr;
    }
    {
        const std::scoped_lock lock(state.mutex);
        state.ending = true;
        state.hears = false;
    }
    state.changed.notify_all();
    const auto until = std::chrono::steady_clock::now() + kEnds;
    const bool sent = state.sending.end(until), noted = state.noting.end(until);
    const std::scoped_lock lock(state.mutex);
    auto tally = state.tally;
    tally.order = state.order;
    tally.dropped = state.dropped;
    tally.hung = !sent || !noted;
    tally.unsent = state.waiting.size();
    return tally;
}

void LslStreams::marker(Instant at, std::string_view text) noexcept {
    state_->hearIf(true, [&] { return Marker{toSeconds(at), std::string(text)}; });
}

void LslStreams::onStream(int id, const SessionStream& stream) noexcept {
    if (stream.kind != "frames") return;
    state_->frameStream = id;
    state_->frameChannels = channelsOf(stream, stream.kind);
}

void LslStreams::onSamples(int stream, const SampleBlock& block) noexcept {
    const auto width = state_->frameChannels.size();
    const bool wanted = stream == state_->frameStream && !state_->markersOnly;
    for (std::size_t i = 0; i < block.samples(); ++i) {
        state_->hearIf(wanted, [&] {
            const auto* values = block.values.data() + i * width;
            return Frame{block.t_s[i], {values, values + width}};
        });
    }
}

void LslStreams::onCommand(const SessionRow& command) noexcept {
    state_->hearIf(TrainJoin::isOfTrains(command.name) && !state_->markersOnly, [&] { return Row{command, true}; });
}

void LslStreams::onEvent(const SessionRow& event) noexcept {
    state_->hearIf(!state_->markersOnly, [&]() -> std::optional<Heard> {
        if (event.name == "refused") return Row{event, false};
        if (auto words = wordsFor(event)) return Marker{toSeconds(event.at), *std::move(words)};
        return std::nullopt;
    });
}

void LslStreams::onTrial(const SessionTrial& trial) noexcept {
    state_->hearIf(!state_->markersOnly, [&] { return Marker{toSeconds(trial.at), wordsFor(trial)}; });
}

}  // namespace tacto
