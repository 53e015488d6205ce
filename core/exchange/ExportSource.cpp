#include "core/exchange/ExportSource.h"

#include <algorithm>
#include <cmath>
#include <fmt/chrono.h>
#include <map>
#include <set>

#include "core/acquisition/StreamHealth.h"
#include "core/base/Clock.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/exchange/ExportTables.h"
#include "core/measure/CaptureFile.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

namespace tacto {

namespace {

using nlohmann::json;

/// Keeps what a name of a file or a data set may hold.
std::string plainName(std::string name) {
    for (auto& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        if (!plain) c = '-';
    }
    return name.empty() ? "stream" : name;
}

/// Replaces a participant's code wherever a text says it: with its hyphens or without, in capitals or not.
void hide(const std::string& code, std::string& text) {
    static constexpr std::string_view kInstead = "the participant";
    const auto isSame = [](char a, char b) { return capital(a) == capital(b); };
    auto plain = code;
    std::erase(plain, '-');
    for (const auto& said : {code, plain}) {
        if (said.empty()) continue;
        for (std::size_t from = 0;;) {
            const auto begin = text.begin() + static_cast<std::ptrdiff_t>(from);
            const auto at = std::search(begin, text.end(), said.begin(), said.end(), isSame);
            if (at == text.end()) break;
            from = static_cast<std::size_t>(at - text.begin());
            text.replace(from, said.size(), kInstead);
            from += kInstead.size();
        }
    }
}

/// The same for a value's texts and the names of its members.
void hide(const std::string& code, json& value) {
    if (code.empty()) return;
    if (value.is_object()) {
        auto hidden = json::object();
        for (auto& [key, each] : value.items()) {
            std::string name = key;
            hide(code, name);
            hide(code, each);
            hidden[name] = std::move(each);
        }
        value = std::move(hidden);
    } else if (value.is_array()) {
        for (auto& each : value) hide(code, each);
    } else if (value.is_string()) {
        hide(code, value.get_ref<std::string&>());
    }
}

/// The bounds of the values of a channel, and how many are absent.
void lookAt(ExportChannel& channel, const SampleBlock& block, std::size_t at, std::size_t columns) {
    for (std::size_t i = at; i < block.values.size(); i += columns) {
        const double value = block.values[i];
        if (std::isnan(value)) {
            ++channel.absent;
        } else if (std::isfinite(value)) {
            if (!(value >= channel.least)) channel.least = value;
            if (!(value <= channel.most)) channel.most = value;
            channel.whole = channel.whole && value == std::floor(value);
        } else {
            ++channel.infinite;
            channel.whole = false;
        }
    }
}

/// Returns the rate that the stamps of a stream are compared with.
double usualRate_hz(double declared_hz, std::span<const double> stamps) {
    constexpr double kFollowed = 0.02;  // SampleGrid follows a rate that is wrong by so much
    const double rough = roughRate_hz(stamps);
    const bool fits =
        std::isfinite(declared_hz) && declared_hz > 0 && !(std::abs(rough / declared_hz - 1) > kFollowed && rough > 0);
    return fits ? declared_hz : rough;
}

std::string wallAtZero(const SessionAbout& about) {
    const auto wall = wallTimeFrom(about.wallStart);
    if (!wall) return about.wallStart;
    const auto zero = *wall - std::chrono::round<std::chrono::seconds>(about.wallStartAt);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(zero)));
}

json streamJson(const ExportStream& stream) {
    auto channels = json::array();
    for (const auto& channel : stream.channels)
        channels.push_back({{"name", channel.name}, {"unit", channel.unit}, {"absent", channel.absent}});
    json out = {{"name", stream.name},
                {"kind", stream.kind},
                {"title", stream.title},
                {"samples", stream.samples},
                {"rate_hz", numberOrNull(stream.rate_hz)},
                {"declared_rate_hz", stream.declaredRate_hz > 0 ? json(stream.declaredRate_hz) : json()},
                {"measured_rate_hz", numberOrNull(stream.measuredRate_hz)},
                {"regular", stream.regular},
                {"first_s", numberOrNull(stream.first_s)},
                {"last_s", numberOrNull(stream.last_s)},
                {"gaps", stream.gapCount},
                {"simulated", stream.simulated},
                {"channels", channels}};
    if (stream.lost > 0) out["lost"] = stream.lost;
    return out;
}

/// Finds the train that each capture shows: the last one from its begin to its trigger, or to its end without one.
class ShownTrains {
public:
    void add(const SessionCaptureInfo& capture) {
        const TimeInterval during{capture.start_s - kTrainLatency_s,
                                  std::isnan(capture.trigger_s)
                                      ? capture.start_s + static_cast<double>(capture.samples) / capture.rate_hz
                                      : capture.trigger_s};
        if (std::isfinite(during.begin_s) && std::isfinite(during.end_s)) {
            all_.push_back({during, count_, {}});
            longest_s_ = std::max(longest_s_, during.end_s - during.begin_s);
        }
        ++count_;
    }
    /// Called when all captures are there.
    void sort() { std::ranges::sort(all_, {}, beginOf); }
    void see(double train_s, double told) {
        for (auto shown = std::ranges::upper_bound(all_, train_s, {}, beginOf);
             shown != all_.begin() && train_s - (--shown)->during.begin_s <= longest_s_;) {
            if (shown->during.contains(train_s))
                shown->train = std::max(shown->train.value_or(std::pair(train_s, told)), std::pair(train_s, told));
        }
    }
    /// In the order of add().
    void tell(std::vector<ExportCapture>& captures) const {
        for (const auto& shown : all_)
            if (shown.train) captures[shown.capture].told = shown.train->second;
    }

private:
    struct Shown {
        TimeInterval during;
        std::size_t capture;
        std::optional<std::pair<double, double>> train;  ///< when, and the amplitude
    };
    static double beginOf(const Shown& shown) noexcept { return shown.during.begin_s; }
    std::vector<Shown> all_;
    std::size_t count_ = 0;
    double longest_s_ = 0;
};

}  // namespace

std::optional<std::size_t> ExportStream::channelR() const noexcept {
    if (kind != "frames") return std::nullopt;
    const auto found = std::ranges::find(channels, "R", &ExportChannel::name);
    if (found == channels.end()) return std::nullopt;
    return static_cast<std::size_t>(found - channels.begin());
}

struct ExportSource::State {
    explicit State(SessionReader opened) : reader(std::move(opened)) {}

    SessionReader reader;
    ExportWatch watch;
    std::string name, version, wallStart, code;
    VerifyReport verified;
    bool damaged = false;
    std::vector<std::string> marks;
    std::vector<std::string> flags;
    std::vector<std::pair<double, bool>> calibrations;  ///< of R, and since when
    std::vector<ExportStream> streams;
    std::vector<ExportCapture> captures;
    std::vector<SessionTrial> trials;
    std::vector<SessionRow> events;
    ExportTable trialTable;
    ShownTrains shown;
    std::uint64_t trains = 0;
    json description;

    // Progress: the part of the work that is being done, and what is done of it.
    mutable double from = 0, to = 0;
    mutable std::uint64_t done = 0, all = 1;

    void part(double begin, double end, std::uint64_t pieces) const {
        from = begin;
        to = end;
        done = 0;
        all = std::max<std::uint64_t>(1, pieces);
    }
    [[nodiscard]] Result<void> goOn(std::uint64_t pieces = 0) const {
        if (watch.stopped && watch.stopped()) return fail(ErrorCode::Stopped, "cancelled; nothing was written");
        done = std::min(done + pieces, all);
        if (watch.progress && pieces > 0)
            watch.progress(from + (to - from) * static_cast<double>(done) / static_cast<double>(all));
        return {};
    }

    [[nodiscard]] Result<void> look(ExportStream& stream) const;
    [[nodiscard]] Result<void> readStreams();
    [[nodiscard]] Result<void> readRows();
    void mark();
    [[nodiscard]] Result<void> describe();
    [[nodiscard]] bool simulated(std::initializer_list<Role> roles) const {
        return simulatedOf(reader.about(), roles, reader.about().simulated);
    }
};

/// Looks through all samples of a stream, once.
Result<void> ExportSource::State::look(ExportStream& stream) const {
    constexpr std::size_t kEnough = 4096;  // stamps, to see the usual rate
    std::vector<double> stamps;
    auto read = reader.forEachChunk(stream.id, [&](const SampleBlock& block) {
        stamps.insert(stamps.end(), block.t_s.begin(), block.t_s.end());
        return stamps.size() < kEnough;
    });
    if (!read) return read;
    const double usual = usualRate_hz(stream.declaredRate_hz, stamps);
    StreamHealth health(usual > 0 ? usual : 1);
    double last = kNaN, shortest = kNaN, longest = kNaN;
    Result<void> went;
    const auto columns = stream.channels.size();
    read = reader.forEachChunk(stream.id, [&](const SampleBlock& block) {
        for (const double t : block.t_s) {
            const double step = t - last;
            if (!(step >= shortest)) shortest = std::isnan(step) ? shortest : step;
            if (!(step <= longest)) longest = std::isnan(step) ? longest : step;
            if (!std::isnan(last) && !(step > 0)) stream.rising = false;
            if (health.feed(t) == StampClass::Gap && stream.gaps.size() < ExportStream::kMaxGaps)
                stream.gaps.push_back({last, t});
            last = t;
        }
        if (stream.samples == 0 && block.samples() > 0) stream.first_s = block.t_s.front();
        stream.samples += block.samples();
        for (std::size_t c = 0; c < columns; ++c) lookAt(stream.channels[c], block, c, columns);
        went = goOn(block.samples());
        return went.has_value();
    });
    if (!read) return read;
    if (!went) return went;
    stream.last_s = last;
    stream.gapCount = health.report().gaps;
    stream.measuredRate_hz = health.report().rate_hz;
    constexpr double kSame = 1e-3;
    const bool declared =
        stream.declaredRate_hz > 0 &&
        (std::isnan(stream.measuredRate_hz) || std::abs(stream.measuredRate_hz / stream.declaredRate_hz - 1) <= kSame);
    stream.rate_hz = declared ? stream.declaredRate_hz : stream.measuredRate_hz;
    const double step = 1 / stream.rate_hz;
    stream.regular = stream.samples < 2 || (shortest >= 0.5 * step && longest <= 1.5 * step);
    return {};
}

Result<void> ExportSource::State::readStreams() {
    const auto found = reader.streams();
    if (!found) return failure(found);
    std::uint64_t samples = 0;
    for (const auto& info : *found) samples += info.samples;
    part(0.1, 0.3, samples);
    std::set<std::string> taken{"trials", "trains", "events", "records"};  // tables have their own names
    const bool fromSensor = simulated({Role::Sensor});
    for (const auto& info : *found) {
        ExportStream stream;
        stream.id = info.id;
        stream.kind = plainName(info.stream.kind);
        stream.name = uniqueName(stream.kind, "-", taken);
        stream.title = info.stream.name;
        hide(code, stream.title);
        stream.channels = channelsOf(info.stream, stream.kind);
        stream.declaredRate_hz = info.stream.rate_hz > 0 ? info.stream.rate_hz : 0;
        stream.simulated = fromSensor;
        if (auto looked = look(stream); !looked) return looked;
        stream.lost = info.samples > stream.samples ? info.samples - stream.samples : 0;
        streams.push_back(std::move(stream));
    }
    return {};
}

Result<void> ExportSource::State::readRows() {
    auto trialRows = reader.trials();
    if (!trialRows) return failure(trialRows);
    trials = std::move(*trialRows);
    auto eventRows = reader.events();
    if (!eventRows) return failure(eventRows);
    events = std::move(*eventRows);
    for (auto& trial : trials) {
        hide(code, trial.condition);
        hide(code, trial.measured);
    }
    for (auto& event : events) {
        hide(code, event.name);
        hide(code, event.body);
    }
    const auto found = reader.captures();
    if (!found) return failure(found);
    // A file is called after the script's own number of the capture, which its trial lists.
    std::map<int, std::vector<int>> listed;
    for (const auto& trial : trials) {
        auto& numbers = listed[trial.number];
        for (const auto& each : valueOr(trial.measured, "captures")) {
            if (each.is_number_integer()) numbers.push_back(each.get<int>());
        }
        std::ranges::sort(numbers);
    }
    std::map<int, std::size_t> count, next;
    std::set<std::string> taken;
    for (const auto& info : *found) ++count[info.trial.value_or(0)];
    for (const auto& info : *found) {
        const int trial = info.trial.value_or(0);
        const auto& numbers = listed[trial];
        const auto at = next[trial]++;
        const auto number = numbers.size() == count[trial] ? numbers[at] : info.seq;
        captures.push_back({.name = uniqueName(fmt::format("trial-{:04}-{:05}", trial, number), "-", taken),
                            .seq = info.seq,
                            .trial = info.trial,
                            .at_s = toSeconds(info.at),
                            .simulated = info.simulated,
                            .samples = info.samples,
                            .channels = info.channels});
        shown.add(info);
    }
    shown.sort();
    return {};
}

void ExportSource::State::mark() {
    const auto& about = reader.about();
    const auto recorded = recordedMarks(events);
    flags = recorded.flags;
    const bool stimulates = std::ranges::any_of(about.devices, [](const auto& d) { return d.is(Role::Stimulator); });
    if (about.simulated) marks.emplace_back("simulated");
    if (stimulates) {
        std::string calibration;
        for (const auto& event : events) {
            if (event.name == "calibration") calibration = textOr(event.body, "text");
        }
        calibration = calibration.substr(0, calibration.find("; applied"));
        if (recorded.stimulatorCalibrated == true && calibration.starts_with("calibrated"))
            marks.push_back("stimulator " + calibration);
        else
            marks.emplace_back("stimulator not calibrated");
    }
    marks.insert(marks.end(), flags.begin(), flags.end());
    if (!recorded.measuredBeyond.empty()) marks.push_back(recorded.measuredBeyond);
    if (!reader.closed()) marks.emplace_back("ended without closing");
    if (reader.closed() && !recorded.complete) marks.emplace_back("marks not recorded");
    if (damaged) marks.emplace_back("damaged");

    const auto calibrated = [](const json& profile) { return flagOr(valueOr(profile, "roughness"), "calibrated"); };
    const auto profile = parseJson(about.profileJson, "the profile of the session", kRowLimits);
    calibrations.emplace_back(-INFINITY, profile && calibrated(*profile));
    for (const auto& event : events) {
        if (event.name == "settings" && event.body.contains("profile"))
            calibrations.emplace_back(toSeconds(event.at), calibrated(event.body["profile"]));
    }
}

Result<void> ExportSource::State::describe() {
    const auto& about = reader.about();
    const auto sentences = sessionMarks(reader);
    if (!sentences) return failure(sentences);
    auto labels = reader.labels();
    if (!labels && damaged) labels = SessionLabels{};
    if (!labels) return failure(labels);
    auto limits = json::array(), devices = json::array(), described = json::array();
    for (const auto& set : about.limitSets) limits.push_back({{"id", set.id}, {"sha256", set.sha256}});
    for (const auto& device : about.devices) {
        devices.push_back({{"role", device.role},
                           {"name", device.name},
                           {"serial", device.serial},
                           {"firmware", device.firmware},
                           {"simulated", isSimulated(device)},
                           {"origin", originOf(device)}});
    }
    for (const auto& stream : streams) described.push_back(streamJson(stream));
    const auto profile = parseJson(about.profileJson, "the profile of the session", kRowLimits);
    auto parameters = about.parameters;
    const bool ofPerson = reader.sealed() || !code.empty();
    if (ofPerson && parameters.is_object()) parameters.erase("participant");  // the code
    description = {{"session", name},
                   {"chain_head", reader.chainHead()},
                   {"wall_start", wallStart},
                   {"duration_s", toSeconds(reader.lastAt())},
                   {"simulated", about.simulated},
                   {"marks", marks},
                   {"statements", *sentences},
                   {"closed", reader.closed()},
                   {"damaged", damaged},
                   {"problems", verified.problems},
                   {"program", {{"recorded_by", about.programVersion}, {"exported_by", version}}},
                   {"protocol", about.protocol},
                   {"protocol_sha256", about.protocolSha256},
                   {"parameters", parameters},
                   {"seed", about.seed},
                   {"mode", about.mode},
                   {"devices", devices},
                   {"profile", profile ? *profile : json()},
                   {"profile_sha256", about.profileSha256},
                   {"limit_sets", limits},
                   {"operator", labels->operatorName},
                   {"sample", labels->sample},
                   {"note", labels->note},
                   {"tags", labels->tags},
                   {"streams", described}};
    hide(code, description);
    return {};
}

ExportSource::ExportSource(std::unique_ptr<State> state) : state_(std::move(state)) {}
ExportSource::ExportSource(ExportSource&&) noexcept = default;
ExportSource& ExportSource::operator=(ExportSource&&) noexcept = default;
ExportSource::~ExportSource() = default;

Result<ExportSource> ExportSource::open(const std::filesystem::path& session, std::shared_ptr<const RowSeal> seal,
                                        ExportWatch watch, std::string_view version, std::string_view code) {
    auto verified = verifySession(session, watch.stopped);
    if (!verified) return failure(verified);
    if (verified->status == SessionStatus::NotASession)
        return fail(ErrorCode::Unsupported, "{}", verified->problems.front());
    const bool damaged = verified->status == SessionStatus::Damaged;
    auto reader =
        damaged ? SessionReader::openDamaged(session, std::move(seal)) : SessionReader::open(session, std::move(seal));
    if (!reader) return failure(reader);
    if (reader->locked())
        return fail(ErrorCode::Unsupported, "{} is sealed; it opens with the passphrase of its study",
                    session.filename().string());
    auto state = std::make_unique<State>(std::move(*reader));
    state->watch = std::move(watch);
    state->name = session.stem().string();
    state->version = version;
    state->code = code;
    hide(state->code, state->name);
    state->wallStart = wallAtZero(state->reader.about());
    state->damaged = damaged;
    state->verified = std::move(*verified);
    if (auto on = state->goOn(); !on) return failure(on);
    if (auto read = state->readStreams(); !read) return failure(read);
    if (auto read = state->readRows(); !read) return failure(read);
    state->mark();
    const auto verdicts = state->reader.verdicts();
    if (!verdicts) return failure(verdicts);
    const auto kind = verdicts->empty() ? state->reader.about().protocol : textOr(verdicts->back().results, "kind");
    state->trialTable = tacto::trialTable(state->trials, kind);
    if (auto described = state->describe(); !described) return failure(described);
    std::uint64_t samples = 0;
    for (const auto& stream : state->streams) samples += stream.samples;
    state->part(0.3, 0.95, samples + state->captures.size());
    ExportSource source(std::move(state));
    auto counted = source.forEachTrain([&](const ExportTrain& train) -> Result<void> {
        ++source.state_->trains;
        if (const double told = std::isnan(train.told_ma) ? train.told_v : train.told_ma; !std::isnan(told))
            source.state_->shown.see(train.time_s, told);
        return {};
    });
    if (!counted) return failure(counted);
    source.state_->shown.tell(source.state_->captures);
    return source;
}

const std::string& ExportSource::name() const noexcept { return state_->name; }
const SessionAbout& ExportSource::about() const noexcept { return state_->reader.about(); }
const std::string& ExportSource::chainHead() const noexcept { return state_->reader.chainHead(); }
const std::string& ExportSource::wallStart() const noexcept { return state_->wallStart; }
double ExportSource::duration_s() const noexcept { return toSeconds(state_->reader.lastAt()); }
const std::string& ExportSource::version() const noexcept { return state_->version; }
bool ExportSource::closed() const noexcept { return state_->reader.closed(); }
bool ExportSource::damaged() const noexcept { return state_->damaged; }
const std::vector<std::string>& ExportSource::problems() const noexcept { return state_->verified.problems; }
bool ExportSource::simulated() const noexcept { return state_->reader.about().simulated; }
bool ExportSource::simulated(const ExportTable& table) const noexcept {
    return &table == &trains() ? state_->simulated({Role::Stimulator, Role::Massager}) : simulated();
}
const std::vector<std::string>& ExportSource::marks() const noexcept { return state_->marks; }
std::string ExportSource::marksText() const { return fmt::format("{}", fmt::join(state_->marks, "; ")); }
const json& ExportSource::description() const noexcept { return state_->description; }
const std::vector<ExportStream>& ExportSource::streams() const noexcept { return state_->streams; }
const std::vector<ExportCapture>& ExportSource::captures() const noexcept { return state_->captures; }
const ExportTable& ExportSource::trials() const noexcept { return state_->trialTable; }
const ExportTable& ExportSource::trains() const noexcept { return trainTable(); }
const ExportTable& ExportSource::events() const noexcept { return eventTable(); }
const ExportTable& ExportSource::records() const noexcept { return recordTable(); }
std::vector<const ExportTable*> ExportSource::tables() const { return {&trials(), &trains(), &events(), &records()}; }
const std::vector<SessionTrial>& ExportSource::trialRows() const noexcept { return state_->trials; }
const std::vector<SessionRow>& ExportSource::eventRows() const noexcept { return state_->events; }
std::uint64_t ExportSource::trainCount() const noexcept { return state_->trains; }
Result<void> ExportSource::goOn() const { return state_->goOn(); }

bool ExportSource::calibratedR(double t_s) const noexcept {
    bool calibrated = false;
    for (const auto& [since, is] : state_->calibrations) {
        if (since <= t_s) calibrated = is;
    }
    return calibrated;
}

bool ExportSource::calibratedR() const noexcept {
    return std::ranges::find(state_->flags, nameOf(RoughnessFlag::UncalibratedR)) == state_->flags.end() &&
           std::ranges::all_of(state_->calibrations, [](const auto& each) { return each.second; });
}

Result<void> ExportSource::forEachChunk(const ExportStream& stream,
                                        const std::function<Result<void>(const SampleBlock&)>& visit) const {
    Result<void> visited;
    std::uint64_t left = stream.samples;  // a session that is still being recorded grows meanwhile
    SampleBlock cut;
    auto read = state_->reader.forEachChunk(stream.id, [&](const SampleBlock& block) {
        const auto samples = std::min<std::uint64_t>(left, block.samples());
        if (samples < block.samples()) {
            cut.t_s.assign(block.t_s.begin(), block.t_s.begin() + static_cast<std::ptrdiff_t>(samples));
            cut.values.assign(block.values.begin(),
                              block.values.begin() + static_cast<std::ptrdiff_t>(samples * stream.channels.size()));
        }
        visited = visit(samples < block.samples() ? cut : block);
        if (visited) visited = state_->goOn(samples);
        left -= samples;
        return visited.has_value() && left > 0;
    });
    return read ? visited : read;
}

Result<void> ExportSource::forEachStamps(const ExportStream& stream,
                                         const std::function<Result<void>(std::span<const double>)>& visit) const {
    Result<void> visited;
    std::uint64_t left = stream.samples;
    auto read = state_->reader.forEachStamps(stream.id, [&](std::span<const double> t_s) {
        t_s = t_s.first(std::min<std::uint64_t>(left, t_s.size()));
        visited = visit(t_s);
        if (visited) visited = state_->goOn();
        left -= t_s.size();
        return visited.has_value() && left > 0;
    });
    return read ? visited : read;
}

Result<std::optional<Capture>> ExportSource::capture(const ExportCapture& wanted) const {
    if (auto on = state_->goOn(1); !on) return failure(on);
    auto read = state_->reader.capture(wanted.seq);
    if (state_->damaged && (!read || !checkWritable(*read))) return std::nullopt;
    if (read) return std::optional(std::move(*read));
    return failure(read);
}

Result<void> ExportSource::forEachTrain(const std::function<Result<void>(const ExportTrain&)>& visit) const {
    std::vector<const SessionRow*> refused;
    for (const auto& event : state_->events) {
        if (event.name == "refused") refused.push_back(&event);
    }
    TrainJoin join(std::move(refused), simulated(trains()));
    Result<void> went;
    auto read = state_->reader.forEachCommand(
        [&](const SessionRow& row) {
            if (!went) return;
            if (state_->code.empty()) {
                went = join.take(row, visit);
            } else {
                auto hidden = row;
                hide(state_->code, hidden.body);
                went = join.take(hidden, visit);
            }
            if (went) went = state_->goOn();
        },
        [&](std::string_view) { return went.has_value(); });  // the rest is passed unread
    if (!read) return read;
    return went ? join.end(visit) : went;
}

Result<void> ExportSource::forEachMoment(const std::function<Result<void>(const ExportRow&)>& visit) const {
    const auto& reader = state_->reader;
    struct Moment {
        std::int64_t seq;
        ExportRow row;
    };
    // All but commands are few; commands are merged with them as they are read.
    std::vector<Moment> few;
    const auto add = [&](const char* kind, const Result<std::vector<SessionRow>>& rows) -> Result<void> {
        if (!rows) return failure(rows);
        for (const auto& row : *rows) few.push_back({row.seq, {toSeconds(row.at), kind, row.name, row.body}});
        return {};
    };
    for (const auto& [kind, rows] : {std::pair("event", Result<std::vector<SessionRow>>(state_->events)),
                                     std::pair("measurement", reader.measurements()),
                                     std::pair("report", reader.reportItems()), std::pair("log", reader.log())}) {
        if (auto added = add(kind, rows); !added) return added;
    }
    const auto verdicts = reader.verdicts();
    if (!verdicts) return failure(verdicts);
    for (const auto& each : *verdicts) {
        few.push_back({each.seq,
                       {toSeconds(each.at),
                        "verdict",
                        each.subject,
                        {{"verdict", each.verdict}, {"reasons", each.reasons}, {"results", each.results}}}});
    }
    for (auto& moment : few) {
        hide(state_->code, moment.row.name);
        hide(state_->code, moment.row.details);
    }
    std::ranges::sort(few, {}, &Moment::seq);
    auto next = few.begin();
    Result<void> went;
    const auto flush = [&](std::int64_t before) {
        for (; went && next != few.end() && next->seq < before; ++next) went = visit(next->row);
        if (went) went = state_->goOn();
    };
    auto read = reader.forEachCommand(
        [&](const SessionRow& row) {
            flush(row.seq);
            ExportRow command{toSeconds(row.at), "command", row.name, row.body};
            hide(state_->code, command.name);
            hide(state_->code, command.details);
            if (went) went = visit(command);
        },
        [&](std::string_view) { return went.has_value(); });
    if (!read) return read;
    flush(std::numeric_limits<std::int64_t>::max());
    return went;
}

Result<void> ExportSource::forEachRow(const ExportTable& table,
                                      const std::function<Result<void>(std::span<const ExportCell>)>& visit) const {
    std::vector<ExportCell> cells;
    const double simulated = this->simulated(table) ? 1 : 0;
    if (&table == &trials()) {
        for (const auto& trial : state_->trials) {
            trialCells(trial, simulated != 0, table, cells);
            if (auto visited = visit(cells); !visited) return visited;
            if (auto on = state_->goOn(); !on) return on;
        }
        return {};
    }
    if (&table == &trains()) {
        return forEachTrain([&](const ExportTrain& train) {
            trainCells(train, cells);
            return visit(cells);
        });
    }
    if (&table == &events()) {
        for (const auto& event : state_->events) {
            cells = {toSeconds(event.at), event.name, dumpJson(event.body), simulated};
            if (auto visited = visit(cells); !visited) return visited;
        }
        return {};
    }
    return forEachMoment([&](const ExportRow& row) -> Result<void> {
        if (row.kind == "event") return {};
        cells = {row.time_s, row.kind, row.name, dumpJson(row.details), simulated};
        return visit(cells);
    });
}

}  // namespace tacto
