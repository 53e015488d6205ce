// The `encoding` section of a profile file, both ways.
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "core/encoding/EncodingProfile.h"

namespace tacto {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 21> kKeys{"amplitude_min_v",
                                                 "amplitude_max_v",
                                                 "interval_min_s",
                                                 "interval_max_s",
                                                 "amplitude_curve",
                                                 "amplitude_beta",
                                                 "interval_curve",
                                                 "interval_beta",
                                                 "assignment",
                                                 "shape",
                                                 "polarity",
                                                 "phase_width_us",
                                                 "inter_phase_gap_us",
                                                 "recharge_ratio",
                                                 "pulses",
                                                 "rate_hz",
                                                 "amplitude_slew_v_per_s",
                                                 "amplitude_ratio_per_train",
                                                 "interval_ratio_per_train",
                                                 "hold",
                                                 "conditions"};

template <class T>
struct Word {
    std::string_view text;
    T value;
};
constexpr std::array<Word<CurveKind>, 3> kCurves{
    {{"linear", CurveKind::Linear}, {"logarithmic", CurveKind::Logarithmic}, {"power", CurveKind::Power}}};
constexpr std::array<Word<Assignment>, 2> kAssignments{
    {{"texture_to_amplitude", Assignment::TextureToAmplitude}, {"swapped", Assignment::Swapped}}};
constexpr std::array<Word<Hold>, 3> kHolds{
    {{"voltage", Hold::Voltage}, {"charge", Hold::Charge}, {"energy", Hold::Energy}}};
constexpr std::array<Word<PulseShape>, 3> kShapes{{{"symmetric", PulseShape::SymmetricBiphasic},
                                                   {"asymmetric", PulseShape::AsymmetricBiphasic},
                                                   {"monophasic", PulseShape::Monophasic}}};
constexpr std::array<Word<Polarity>, 2> kPolarities{
    {{"positive", Polarity::Positive}, {"negative", Polarity::Negative}}};

template <class T, std::size_t N>
std::string_view wordFor(const std::array<Word<T>, N>& words, T value) {
    for (const auto& word : words) {
        if (word.value == value) return word.text;
    }
    return words.front().text;
}

/// Reads keys one after the other and keeps the first error.
class Reader {
public:
    explicit Reader(const json& section) : section_(section) {}

    void number(const char* key, const auto& assign) {
        const auto* value = find(key);
        if (value == nullptr) return;
        if (!value->is_number()) return refuse(key, *value, "a number");
        assign(value->get<double>());
    }

    void integer(const char* key, int& into) {
        const auto* value = find(key);
        if (value == nullptr) return;
        if (!value->is_number()) return refuse(key, *value, "a whole number");
        const double x = value->get<double>();
        if (!(x >= std::numeric_limits<int>::min() && x <= std::numeric_limits<int>::max()) || x != std::floor(x)) {
            return refuse(key, *value, "a whole number");
        }
        into = static_cast<int>(x);
    }

    template <class T, std::size_t N>
    void word(const char* key, const std::array<Word<T>, N>& words, T& into) {
        const auto* value = find(key);
        if (value == nullptr) return;
        std::string accepted = "one of";
        for (const auto& each : words) {
            if (value->is_string() && value->get_ref<const std::string&>() == each.text) {
                into = each.value;
                return;
            }
            accepted += fmt::format(" \"{}\"", each.text);
        }
        refuse(key, *value, accepted);
    }

    void conditions(std::vector<Condition>& into) {
        const auto* list = find("conditions");
        if (list == nullptr) return;
        if (!list->is_array()) return refuse("conditions", *list, "a list of {\"name\", \"R\", \"P\"}");
        into.clear();
        for (const auto& item : *list) {
            const bool complete = item.is_object() && item.size() == 3 && item.contains("name") && item.contains("R") &&
                                  item.contains("P") && item["name"].is_string() && item["R"].is_number() &&
                                  item["P"].is_number();
            if (!complete) return refuse("conditions", item, "{\"name\": text, \"R\": number, \"P\": number}");
            into.push_back({item["name"].get<std::string>(), item["R"].get<double>(), item["P"].get<double>()});
        }
    }

    [[nodiscard]] const Result<void>& outcome() const { return outcome_; }

private:
    const json* find(const char* key) const {
        if (!outcome_) return nullptr;
        const auto found = section_.find(key);
        return found == section_.end() ? nullptr : &*found;
    }
    void refuse(const char* key, const json& value, std::string_view accepted) {
        outcome_ = fail(ErrorCode::ParseError, "encoding.{} is {}, not {}", key, shownJson(value), accepted);
    }

    const json& section_;
    Result<void> outcome_;
};

}  // namespace

Result<EncodingProfile> encodingProfileFrom(const json& section) {
    if (auto known = onlyKeys(section, kKeys, "encoding"); !known) return failure(known);
    EncodingProfile p;
    Reader read(section);
    read.number("amplitude_min_v", [&](double x) { p.amplitudeMin = Volts(x); });
    read.number("amplitude_max_v", [&](double x) { p.amplitudeMax = Volts(x); });
    read.number("interval_min_s", [&](double x) { p.intervalMin = Seconds(x); });
    read.number("interval_max_s", [&](double x) { p.intervalMax = Seconds(x); });
    read.word("amplitude_curve", kCurves, p.amplitudeCurve.kind);
    read.number("amplitude_beta", [&](double x) { p.amplitudeCurve.beta = x; });
    read.word("interval_curve", kCurves, p.intervalCurve.kind);
    read.number("interval_beta", [&](double x) { p.intervalCurve.beta = x; });
    read.word("assignment", kAssignments, p.assignment);
    read.word("shape", kShapes, p.train.shape);
    read.word("polarity", kPolarities, p.train.polarity);
    read.number("phase_width_us", [&](double x) { p.train.phaseWidth = Micros(x); });
    read.number("inter_phase_gap_us", [&](double x) { p.train.interPhaseGap = Micros(x); });
    read.number("recharge_ratio", [&](double x) { p.train.rechargeRatio = x; });
    read.integer("pulses", p.train.pulses);
    read.number("rate_hz", [&](double x) { p.train.rate = Hertz(x); });
    read.number("amplitude_slew_v_per_s", [&](double x) { p.amplitudeSlew_V_per_s = x; });
    read.number("amplitude_ratio_per_train", [&](double x) { p.amplitudeRatioPerTrain = x; });
    read.number("interval_ratio_per_train", [&](double x) { p.intervalRatioPerTrain = x; });
    read.word("hold", kHolds, p.hold);
    read.conditions(p.conditions);
    if (!read.outcome()) return failure(read.outcome());
    if (auto valid = validate(p); !valid) return fail(valid.error().code, "encoding: {}", valid.error().message);
    return p;
}

json toJson(const EncodingProfile& p) {
    json conditions = json::array();
    for (const auto& c : p.conditions) conditions.push_back({{"name", c.name}, {"R", c.R}, {"P", c.P}});
    return {{"amplitude_min_v", p.amplitudeMin.value()},
            {"amplitude_max_v", p.amplitudeMax.value()},
            {"interval_min_s", p.intervalMin.count()},
            {"interval_max_s", p.intervalMax.count()},
            {"amplitude_curve", nameOf(p.amplitudeCurve.kind)},
            {"amplitude_beta", p.amplitudeCurve.beta},
            {"interval_curve", nameOf(p.intervalCurve.kind)},
            {"interval_beta", p.intervalCurve.beta},
            {"assignment", nameOf(p.assignment)},
            {"shape", wordFor(kShapes, p.train.shape)},
            {"polarity", wordFor(kPolarities, p.train.polarity)},
            {"phase_width_us", p.train.phaseWidth.count()},
            {"inter_phase_gap_us", p.train.interPhaseGap.count()},
            {"recharge_ratio", p.train.rechargeRatio},
            {"pulses", p.train.pulses},
            {"rate_hz", p.train.rate.value()},
            {"amplitude_slew_v_per_s", p.amplitudeSlew_V_per_s},
            {"amplitude_ratio_per_train", p.amplitudeRatioPerTrain},
            {"interval_ratio_per_train", p.intervalRatioPerTrain},
            {"hold", nameOf(p.hold)},
            {"conditions", conditions}};
}

}  // namespace tacto
