#include "core/exchange/bids/NibsFiles.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "core/base/JsonText.h"
#include "core/exchange/bids/TsvOut.h"
#include "core/measure/PulseMeasurement.h"
#include "core/study/StudyLog.h"

namespace tacto {

namespace {

using nlohmann::json;

// https://github.com/nigelrogasch/nibs-bids, folder nibs-bids-v6: the text of version 6.2, tPCS in its section on TES.
constexpr const char* kNibsVersion = "6.2";
constexpr const char* kNibsCommit = "77de0bdcefcaf891b55adbf6288fc6736568e6cf";

/// A reading with its expanded uncertainty (95 %); NaN: not measured, or not stated.
struct Reading {
    double value = kNaN, U = kNaN;
};

/// What an oscilloscope's record shows of a train.
struct TrainSeen {
    Reading voltage, current;     ///< V, mA
    Reading width, gap;           ///< s, of the leading phase and between the phases
    Reading interval;             ///< s, to the next train
    Reading charge;               ///< uC, of the leading phase
    std::size_t capture = kNone;  ///< position in ExportSource::captures()

    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

/// What is kept of each train that was put out while captures and frames are read.
struct TrainCause {
    std::uint64_t number = 0;  ///< of all trains, from 1
    double time_s = kNaN;
    double R = kNaN, P = kNaN;
    double rate_hz = kNaN;  ///< of its pulses
    bool fromSensor = false;
    double frame_s = kNaN;  ///< of the frame that it was made from
};

/// Whether a train may have come out.
bool wasPutOut(const ExportTrain& train) {
    using enum ExportTrain::Outcome;
    return train.outcome != Refused && train.outcome != Voided && train.outcome != Burst;
}

/// From the leading edge of a pulse to the end of its last phase.
double pulseDuration_s(const json& body) {
    const double width = numberOr(body, "width_s"), ratio = numberOr(body, "recharge_ratio");
    if (textOr(body, "text").starts_with("monophasic")) return width;
    return width + numberOr(body, "gap_s") + width * (std::isnan(ratio) ? 1 : ratio);
}

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

class NibsWriter {
public:
    NibsWriter(const ExportSource& source, const BidsFolder& folder) : source_(source), folder_(folder) {
        for (const auto& event : source.eventRows()) {
            // One at the edge of its range is no threshold.
            if (event.name == "estimate" && !flagOr(event.body, "at_edge"))
                detections_.emplace_back(toSeconds(event.at), numberOr(valueOr(event.body, "estimate"), "value"));
        }
    }

    Result<void> write() {
        for (const auto step : {&NibsWriter::readTrains, &NibsWriter::readFrames, &NibsWriter::readCaptures,
                                &NibsWriter::writeTable, &NibsWriter::writeSidecar}) {
            if (auto done = (this->*step)(); !done) return done;
        }
        return {};
    }

private:
    static constexpr double kEarly_s = 0.001;  // the record's own time base

    struct Row {
        const ExportTrain& train;
        const TrainCause& cause;
        const TrainSeen& seen;
        std::string stimulus;
    };
    struct Column {
        BidsColumn about;
        std::function<ExportCell(const Row&)> cell;
    };

    Result<void> readTrains() {
        std::uint64_t number = 0;
        auto read = source_.forEachTrain([&](const ExportTrain& train) -> Result<void> {
            ++number;
            if (!wasPutOut(train)) return {};
            causes_.push_back({.number = number,
                               .time_s = train.time_s,
                               .R = train.roughness,
                               .P = train.pressure,
                               .rate_hz = numberOr(train.details, "rate_hz"),
                               .fromSensor = train.drivenBy == "sensor"});
            return {};
        });
        byTime_.resize(causes_.size());
        for (std::size_t i = 0; i < byTime_.size(); ++i) byTime_[i] = i;
        std::ranges::stable_sort(byTime_, {}, [&](std::size_t i) { return causes_[i].time_s; });
        return read;
    }

    /// Finds the frame of each train: the newest before it that has its R and P.
    Result<void> readFrames() {
        constexpr double kOldest_s = 1;  // the loop uses no frame that is as old
        const auto frames = std::ranges::find(source_.streams(), "frames", &ExportStream::kind);
        if (frames == source_.streams().end()) return {};
        const auto at = [&](const char* name) {
            return static_cast<std::size_t>(std::ranges::find(frames->channels, name, &ExportChannel::name) -
                                            frames->channels.begin());
        };
        const auto width = frames->channels.size(), r = at("R"), p = at("P");
        if (r >= width || p >= width) return {};
        struct Frame {
            double t_s, R, P;
        };
        std::deque<Frame> recent;
        auto next = byTime_.begin();
        const auto settleUntil = [&](double t_s) {
            for (; next != byTime_.end() && causes_[*next].time_s < t_s; ++next) {
                auto& cause = causes_[*next];
                if (!cause.fromSensor) continue;
                const auto frame = std::find_if(recent.rbegin(), recent.rend(), [&](const Frame& each) {
                    return each.t_s <= cause.time_s && isSame(each.R, cause.R) && isSame(each.P, cause.P);
                });
                if (frame != recent.rend()) cause.frame_s = frame->t_s;
            }
        };
        auto read = source_.forEachChunk(*frames, [&](const SampleBlock& block) -> Result<void> {
            for (std::size_t i = 0; i < block.samples(); ++i) {
                const Frame frame{block.t_s[i], block.values[i * width + r], block.values[i * width + p]};
                settleUntil(frame.t_s);
                recent.push_back(frame);
                while (recent.front().t_s < frame.t_s - kOldest_s) recent.pop_front();
            }
            return {};
        });
        settleUntil(INFINITY);
        return read;
    }

    /// Measures every capture that shows a train, and the interval from one capture to the next.
    Result<void> readCaptures() {
        std::vector<Capture> two;  // the capture before and this one
        for (std::size_t c = 0; c < source_.captures().size(); ++c) {
            auto capture = source_.capture(source_.captures()[c]);
            if (!capture) return failure(capture);
            if (!*capture) continue;
            two.push_back(std::move(**capture));
            if (two.size() > 2) two.erase(two.begin());
            const auto options = optionsFor(two.back());
            const auto& channels = two.back().channels;
            for (std::size_t channel = 0; channel < channels.size(); ++channel) {
                const auto& unit = channels[channel].unit;
                if (unit != "V" && unit != "A") continue;
                take(measureChannel(two.back(), channel, options), c);
                if (const auto both = measureTrains(two, channels[channel].name, options)) takeIntervals(*both);
            }
        }
        return {};
    }

    /// Pulses of one train are as far apart as its rate says.
    [[nodiscard]] MeasureOptions optionsFor(const Capture& capture) const {
        MeasureOptions options;
        const double end_s = capture.start_s + static_cast<double>(capture.samples()) / capture.rate_hz;
        auto shown = std::ranges::lower_bound(byTime_, capture.start_s - kTrainLatency_s, {},
                                              [&](std::size_t i) { return causes_[i].time_s; });
        for (; shown != byTime_.end() && causes_[*shown].time_s < end_s; ++shown) {
            if (const double rate = causes_[*shown].rate_hz; rate > 0) options.intraTrainRate = Hertz(rate);
        }
        return options;
    }

    /// The position in byTime_ of the train that a pulse at `t_s` belongs to: the last that was begun shortly before.
    [[nodiscard]] std::optional<std::size_t> trainAt(double t_s) const {
        const auto behind =
            std::ranges::upper_bound(byTime_, t_s + kEarly_s, {}, [&](std::size_t i) { return causes_[i].time_s; });
        if (behind == byTime_.begin()) return std::nullopt;
        const auto train = std::prev(behind);
        if (causes_[*train].time_s < t_s - kTrainLatency_s) return std::nullopt;
        return static_cast<std::size_t>(train - byTime_.begin());
    }

    static void set(Reading& reading, double value, double standard) {
        if (std::isnan(reading.value) && !std::isnan(value)) reading = {value, kCoverage * standard};
    }

    void take(const ChannelMeasurement& channel, std::size_t position) {
        const auto& u = channel.uncertainty;
        for (std::size_t i = 0; i < channel.trains.size(); ++i) {
            const auto& train = channel.trains[i];
            const auto at = train.pulses > 0 ? trainAt(train.onset_s) : std::nullopt;
            if (!at) continue;
            auto& seen = seen_[byTime_[*at]];
            if (seen.capture == TrainSeen::kNone) seen.capture = position;
            if (seen.capture != position) continue;
            constexpr double kMilli = 1e3, kMicro = 1e6;
            if (channel.unit == "A") {
                set(seen.current, kMilli * train.amplitude, kMilli * u.amplitude);
                set(seen.charge, kMicro * train.charge, kMicro * u.charge);
            } else {
                set(seen.voltage, train.amplitude, u.amplitude);
            }
            set(seen.width, train.width_s, u.width_s);
            set(seen.gap, gapIn(channel, train.onset_s, i), u.gap_s);
        }
    }

    /// Takes the intervals between trains that follow one another.
    void takeIntervals(const ChannelMeasurement& channel) {
        for (std::size_t i = 0; i + 1 < channel.trains.size(); ++i) {
            const auto at = trainAt(channel.trains[i].onset_s), next = trainAt(channel.trains[i + 1].onset_s);
            if (at && next && *next == *at + 1)
                set(seen_[byTime_[*at]].interval, channel.trains[i].interval_s, channel.uncertainty.interval_s);
        }
    }

    /// The mean gap of the pulses of a channel's `i`-th train.
    static double gapIn(const ChannelMeasurement& channel, double onset_s, std::size_t i) {
        const double end_s = i + 1 < channel.trains.size() ? channel.trains[i + 1].onset_s : INFINITY;
        double sum = 0;
        std::size_t count = 0;
        for (const auto& pulse : channel.pulses) {
            if (!(pulse.onset_s() >= onset_s && pulse.onset_s() < end_s) || std::isnan(pulse.gap_s)) continue;
            sum += pulse.gap_s;
            ++count;
        }
        return count > 0 ? sum / static_cast<double>(count) : kNaN;
    }

    /// Returns the detection threshold that was measured last before `t_s`; NaN if none was.
    [[nodiscard]] double detectionAt_ma(double t_s) const {
        double found = kNaN;
        for (const auto& [at_s, threshold] : detections_) {
            if (at_s <= t_s) found = threshold;
        }
        return found;
    }

    /// Returns the identifier of the stimulus that a train consists of, which is described once.
    std::string stimulusOf(const ExportTrain& train) {
        const auto& body = train.details;
        if (!body.is_object()) return {};
        const double pulses = numberOr(body, "pulses"), rate = numberOr(body, "rate_hz");
        const bool isCurrent = body.contains("amplitude_ma");
        json about{{"StimulusType", "tPCS"},
                   {"StimulusControlMode", isCurrent ? "current-controlled" : "voltage-controlled"},
                   {"StimulusWaveform", "pulse"},
                   {"PulseWaveform", textOr(body, "text")},
                   {"PulseCount", numberOrNull(pulses)},
                   {"PulseDuration", numberOrNull(pulseDuration_s(body))},
                   {"PulseDurationUnits", "s"},
                   {"PhaseWidth", numberOrNull(numberOr(body, "width_s"))},
                   {"PhaseWidthUnits", "s"},
                   {"InterPhaseGap", numberOrNull(numberOr(body, "gap_s"))},
                   {"InterPhaseGapUnits", "s"},
                   {"RechargeRatio", numberOrNull(numberOr(body, "recharge_ratio"))}};
        if (pulses > 1) {
            about["PulseRepetitionInterval"] = numberOrNull(1 / rate);
            about["PulseRepetitionIntervalUnits"] = "s";
        }
        auto& id = stimuli_[dumpJson(about)];
        if (id.empty()) {
            id = fmt::format("stim_{}", stimuli_.size());
            about["StimID"] = id;
            stimulusSet_.push_back(std::move(about));
        }
        return id;
    }

    [[nodiscard]] std::vector<Column> columns() const;

    Result<void> writeTable() {
        const auto path = folder_.path("nibs", "stimsys-tes_nibs.tsv");
        if (!path) return failure(path);
        TsvOut out(*path);
        const auto all = columns();
        for (const auto& column : all) out.text(column.about.name);
        if (auto ended = out.endRow(); !ended) return ended;
        std::size_t at = 0;
        const TrainSeen none;
        auto read = source_.forEachTrain([&](const ExportTrain& train) -> Result<void> {
            if (!wasPutOut(train) || at >= causes_.size()) return {};
            const auto seen = seen_.find(at);
            const Row row{train, causes_[at], seen == seen_.end() ? none : seen->second, stimulusOf(train)};
            ++at;
            for (const auto& column : all) out.cell(column.cell(row));
            return out.endRow();
        });
        return read ? out.end() : read;
    }

    Result<void> writeSidecar();
    [[nodiscard]] json electrodes() const;
    [[nodiscard]] json particulars() const;
    [[nodiscard]] json eventsNamed(std::string_view name) const;

    const ExportSource& source_;
    const BidsFolder& folder_;
    std::vector<TrainCause> causes_;
    std::vector<std::size_t> byTime_;  ///< positions in causes_
    std::map<std::size_t, TrainSeen> seen_;
    std::vector<std::pair<double, double>> detections_;  ///< when each threshold was measured, and what it was, mA
    std::map<std::string, std::string> stimuli_;
    json stimulusSet_ = json::array();
};

std::vector<NibsWriter::Column> NibsWriter::columns() const {
    std::vector<Column> all;
    const auto number = [&](const char* name, std::string description, const char* unit, auto cell) {
        all.push_back({{name, std::move(description), unit},
                       [cell](const Row& row) -> ExportCell { return static_cast<double>(cell(row)); }});
    };
    using Levels = std::vector<std::pair<std::string, std::string>>;
    const auto word = [&](const char* name, std::string description, auto cell, Levels levels = {}) {
        all.push_back({{name, std::move(description), "", std::move(levels)},
                       [cell](const Row& row) -> ExportCell { return std::string(cell(row)); }});
    };
    const auto told = [&](const char* name, std::string description, const char* unit, const char* key) {
        number(name, std::move(description), unit, [key](const Row& row) { return numberOr(row.train.details, key); });
    };
    // Of the draft.
    word("event_id", "The train, as in _events.tsv", [](const Row& row) { return bidsEventId(row.cause.number); });
    word("electrode_id", "The leading electrode, in ElectrodeSet", [](const Row&) { return "elec_1"; });
    word("stim_id", "The stimulus, in StimulusSet", [](const Row& row) { return row.stimulus; });
    number("train_duration", "From the train's onset to the end of its last pulse, as commanded", "s",
           [](const Row& row) { return outputDuration_s(row.train); });
    number("base_voltage_intensity", "Amplitude that the device was sent", "V",
           [](const Row& row) { return row.train.told_v; });
    number("base_current_intensity", "Amplitude that the device was sent", "mA",
           [](const Row& row) { return row.train.told_ma; });
    word("threshold_type", "Kind of the threshold beside it",
         [this](const Row& row) { return std::isfinite(detectionAt_ma(row.train.time_s)) ? "sensation" : ""; },
         {{"sensation", "detection, 80 % right of two intervals"}});
    number("threshold_reference_current", "Threshold as it was measured last before the train", "mA",
           [this](const Row& row) { return detectionAt_ma(row.train.time_s); });
    number("contact_impedance", "Impedance of both electrodes, as the device measured it", "ohm",
           [](const Row& row) { return row.train.impedance_ohm; });
    number("measured_voltage_intensity", "Amplitude that the device read back", "V",
           [](const Row& row) { return row.train.readBack_v; });
    number("measured_current_intensity", "Amplitude that the device read back", "mA",
           [](const Row& row) { return row.train.readBack_ma; });
    word("status", "What became of the train", [](const Row& row) { return std::string(nameOf(row.train.outcome)); },
         {{"delivered", "the device delivered it"},
          {"check", "the device delivered a pulse that measures the impedance"},
          {"failed", "the device refused it, vanished or did not answer"}});
    word("status_description", "Why it failed", [](const Row& row) { return row.train.reason; });
    // Beside the draft: when, and what was commanded.
    number("onset", "Time of the train since the session's start", "s",
           [](const Row& row) { return row.train.time_s; });
    number("encoded_voltage", "Amplitude A that the encoder wanted (EncodingProfile)", "V",
           [](const Row& row) { return row.train.command_v; });
    number("held_voltage", "A adapted to the load's impedance", "V", [](const Row& row) { return row.train.held_v; });
    number("rounded_by", "Share by which the device's step made the amplitude smaller", "1",
           [](const Row& row) { return row.train.roundedBy; });
    told("commanded_pulses", "Number of pulses", "1", "pulses");
    told("commanded_pulse_rate", "Rate of the pulses in the train", "Hz", "rate_hz");
    told("commanded_width", "Width of the leading phase that the device was sent", "s", "width_s");
    told("commanded_gap", "Gap between the phases that the device was sent", "s", "gap_s");
    number("commanded_interval", "Interval to the next train", "s",
           [](const Row& row) { return row.train.interval_s; });
    number("commanded_charge", "Charge of the leading phase of a current source: amplitude times width", "uC",
           [](const Row& row) { return row.train.told_ma * numberOr(row.train.details, "width_s") * 1e3; });
    number("imbalance", "Net charge over phase charge of a pulse, as the device measured it", "1",
           [](const Row& row) { return row.train.imbalance; });
    // As measured.
    const auto reading = [&](const std::string& name, const std::string& what, const char* unit,
                             Reading TrainSeen::*member) {
        number(name.c_str(), what + ", as the oscilloscope shows it", unit,
               [member](const Row& row) { return (row.seen.*member).value; });
        number((name + "_u").c_str(), "Expanded uncertainty (95 %) of " + name, unit,
               [member](const Row& row) { return (row.seen.*member).U; });
    };
    reading("scope_voltage", "Amplitude of the leading phase", "V", &TrainSeen::voltage);
    reading("scope_current", "Amplitude of the leading phase", "mA", &TrainSeen::current);
    reading("scope_width", "Width of the leading phase", "s", &TrainSeen::width);
    reading("scope_gap", "Gap between the phases", "s", &TrainSeen::gap);
    reading("scope_interval", "Interval to the next train", "s", &TrainSeen::interval);
    reading("scope_charge", "Charge of the leading phase", "uC", &TrainSeen::charge);
    // The cause.
    word("driven_by", "What chose the train", [](const Row& row) { return row.train.drivenBy; },
         {{"sensor", "roughness and pressure of the fingertip"},
          {"manual", "roughness and pressure that a person or a script set"},
          {"presentation", "a level and an interval that a procedure presented"},
          {"check", "the program, to measure the impedance"}});
    number("frame_time", "Time of the fingertip's frame that it was made from: the newest with this R and P", "s",
           [](const Row& row) { return row.cause.frame_s; });
    number("roughness", "Roughness R that it was made from", "1", [](const Row& row) { return row.train.roughness; });
    number("pressure", "Pressure P that it was made from", "1", [](const Row& row) { return row.train.pressure; });
    word("nearest_limit", "The limit of the safety gate that it came nearest to, with the trains before it",
         [](const Row& row) { return row.train.limit; });
    number("nearest_limit_share", "What it takes of that limit", "1",
           [](const Row& row) { return row.train.limitShare; });
    word("capture", "The oscilloscope's record that shows it, by its name in csv and hdf5 exports",
         [this](const Row& row) {
             return row.seen.capture == TrainSeen::kNone ? std::string() : source_.captures()[row.seen.capture].name;
         });
    number("simulated", "1: simulated, 0: not", "1", [](const Row& row) { return row.train.simulated ? 1.0 : 0.0; });
    return all;
}

json NibsWriter::eventsNamed(std::string_view name) const {
    auto all = json::array();
    for (const auto& event : source_.eventRows()) {
        if (event.name != name || !event.body.is_object()) continue;
        auto each = event.body;
        each["time_s"] = toSeconds(event.at);
        all.push_back(std::move(each));
    }
    return all;
}

/// What the session's profile knows of the electrodes (core/bench/Profile.h); a study's record knows the rest.
json NibsWriter::electrodes() const {
    const auto profile = valueOr(source_.description(), "profile");
    const double area = numberOr(valueOr(profile, "safety"), "electrode_area_cm2");
    const auto word = [described = valueOr(profile, "electrode")](const char* key) {
        auto text = textOr(described, key);
        return text.empty() ? std::string(kNoWord) : text;
    };
    auto set = json::array();
    for (const auto& [id, role] : {std::pair{"elec_1", "other: leads, its phase comes first"}, {"elec_2", "return"}}) {
        json each{{"ElectrodeID", id},
                  {"ElectrodeRole", role},
                  {"ElectrodeName", word("name")},
                  {"ElectrodeMaterial", word("material")},
                  {"ElectrodeContactMedium", word("medium")},
                  {"ElectrodeShape", kNoWord}};
        if (std::isfinite(area)) each["ElectrodeArea"] = {{"Value", area}, {"Units", "cm^2"}};
        set.push_back(std::move(each));
    }
    return set;
}

/// The items that standards of reporting ask for (StudyLog.h): what the session knows, the others open.
json NibsWriter::particulars() const {
    std::map<std::string, std::string> known;
    for (const auto& device : source_.about().devices) {
        if (!device.is(Role::Stimulator)) continue;
        known["stimulator_model"] = device.name;
        known["stimulator_serial"] = device.serial;
    }
    auto all = json::object();
    const auto kind = studyLogKind(kParticulars);
    if (!kind) return all;
    for (const auto& field : (*kind)->fields) {
        const auto found = known.find(field.key);
        const auto text = found == known.end() || found->second.empty() ? std::string(kNoWord) : found->second;
        all[field.exported != nullptr ? field.exported : field.label] = text;
    }
    return all;
}

Result<void> NibsWriter::writeSidecar() {
    const auto& session = source_.description();
    auto about = folder_.sidecar(source_.simulated(source_.trains()));
    about["StimulationSystem"] = "tes (electrical stimulation through electrodes on the skin, or into a load)";
    about["NIBSBIDS"] = nibsVersion();
    for (const auto& device : source_.about().devices) {
        if (!device.is(Role::Stimulator)) continue;
        about["ManufacturersModelName"] = device.name;
        about["DeviceSerialNumber"] = device.serial;
        about["SoftwareVersion"] = device.firmware;
    }
    about["ElectrodeSet"] = electrodes();
    about["StimulusSet"] = stimulusSet_;
    const auto estimates = eventsNamed("estimate"), ranges = eventsNamed("range");
    about["Thresholds"] = estimates.empty() ? json(kNoWord) : estimates;
    about["PersonalRange"] = ranges.empty() ? json(kNoWord) : ranges;
    about["EncodingProfile"] = valueOr(session, "profile");
    about["EncodingProfileChanges"] = eventsNamed("settings");
    about["Calibrations"] = eventsNamed("calibration");
    about["Armings"] = eventsNamed("arming");
    about["LimitSets"] = valueOr(session, "limit_sets");
    about["Particulars"] = particulars();
    std::vector<BidsColumn> all;
    for (const auto& column : columns()) all.push_back(column.about);
    about.update(BidsTable(std::move(all)).sidecar());
    const auto path = folder_.path("nibs", "stimsys-tes_nibs.json");
    return path ? folder_.writeJson(*path, about) : failure(path);
}

}  // namespace

bool hasNibsFiles(const ExportSource& source) noexcept {
    const auto& devices = source.about().devices;
    return std::ranges::any_of(devices, [](const auto& each) { return each.is(Role::Stimulator); }) ||
           std::ranges::none_of(devices, [](const auto& each) { return each.is(Role::Massager); });
}

json nibsVersion() {
    return {{"Proposal", "BEP037, nigelrogasch/nibs-bids"}, {"Version", kNibsVersion}, {"Commit", kNibsCommit}};
}

double outputDuration_s(const ExportTrain& train) {
    const auto& body = train.details;
    if (train.outcome == ExportTrain::Outcome::Burst) return numberOr(body, "duration_s");
    return (numberOr(body, "pulses") - 1) / numberOr(body, "rate_hz") + pulseDuration_s(body);
}

Result<void> writeNibsFiles(const ExportSource& source, const BidsFolder& folder) {
    return NibsWriter(source, folder).write();
}

}  // namespace tacto
