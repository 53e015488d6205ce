#include "core/measure/InstrumentProfile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

using ProfileJson = nlohmann::json;

constexpr std::array<std::string_view, 4> kSheetConfidences{"high", "medium", "medium-low", "low"};
constexpr std::array<std::string_view, 2> kGainOf{"reading", "full scale"};
constexpr double kMaxPct = 50;
constexpr double kMaxPpm = 1e5;

bool sameLetters(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b,
                              [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool modelMatches(std::string_view pattern, std::string_view model) {
    if (!pattern.ends_with('*')) return sameLetters(pattern, model);
    pattern.remove_suffix(1);
    return model.size() >= pattern.size() && sameLetters(pattern, model.substr(0, pattern.size()));
}

/// Reads the keys of one object; the first fault is kept and everything after it is skipped.
class SheetReader {
public:
    SheetReader(const ProfileJson& object, std::string where) : object_(object), where_(std::move(where)) {}

    void only(std::initializer_list<std::string_view> known) {
        if (auto keys = onlyKeys(object_, known, where_); !keys) fault_ = std::move(keys.error());
    }
    void text(const char* key, std::string& into, bool required = true) {
        const auto* value = find(key, required);
        if (value == nullptr) return;
        const auto* found = value->get_ptr<const std::string*>();
        if (found == nullptr || found->empty()) return refuse(key, value, "a text that is not empty");
        into = *found;
    }
    template <std::size_t N>
    void oneOf(const char* key, const std::array<std::string_view, N>& names, std::string& into) {
        text(key, into);
        if (fault_ || std::ranges::find(names, into) != names.end()) return;
        refuse(key, &object_.at(key), fmt::format("{}", fmt::join(names, ", ")));
    }
    /// `into` = the number times `scale`.
    void number(const char* key, double most, double scale, double& into, bool required = true) {
        const auto* value = find(key, required);
        if (value == nullptr) return;
        const double found = value->is_number() ? value->get<double>() : kNaN;
        if (!(found >= 0) || !(found <= most)) return refuse(key, value, fmt::format("a number from 0 to {:g}", most));
        into = found * scale;
    }
    /// A list of patterns or names: at least one, none empty, a * at the end alone and behind something.
    void names(const char* key, bool patterns, std::vector<std::string>& into) {
        const auto* value = find(key, true);
        if (value == nullptr) return;
        if (!value->is_array() || value->empty()) return refuse(key, value, "a list of texts");
        for (const auto& each : *value) {
            const auto* name = each.get_ptr<const std::string*>();
            const auto star = name == nullptr ? std::string::npos : name->find('*');
            if (name == nullptr || name->empty() ||
                (star != std::string::npos && (!patterns || star == 0 || star + 1 != name->size()))) {
                return refuse(key, &each, patterns ? "a model, or its beginning and *" : "a maker's name");
            }
            into.push_back(*name);
        }
    }
    /// The object under `key`; null where the figure is stated to be unknown.
    [[nodiscard]] const ProfileJson* object(const char* key) {
        const auto* value = find(key, true);
        if (value == nullptr || value->is_null()) return nullptr;
        if (value->is_object()) return value;
        refuse(key, value, "an object, or null where no source is known");
        return nullptr;
    }
    void take(std::optional<Error> fault) {
        if (!fault_) fault_ = std::move(fault);
    }
    [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
    [[nodiscard]] const std::string& where() const { return where_; }

private:
    const ProfileJson* find(const char* key, bool required) {
        if (fault_) return nullptr;
        const auto found = object_.find(key);
        if (found != object_.end()) return &*found;
        if (required) refuse(key, nullptr, "it");
        return nullptr;
    }
    void refuse(const char* key, const ProfileJson* value, std::string_view accepted) {
        fault_ = value == nullptr
                     ? Error{ErrorCode::ParseError, fmt::format("{}: \"{}\" is missing; it is required", where_, key)}
                     : Error{ErrorCode::ParseError,
                             fmt::format("{}: \"{}\" is {}; accepted: {}", where_, key, shownJson(*value), accepted)};
    }

    const ProfileJson& object_;
    std::string where_;
    std::optional<Error> fault_;
};

void readSheetSource(SheetReader& reader, SheetFigure& into) {
    reader.text("source", into.source);
    reader.text("address", into.address);
    reader.oneOf("confidence", kSheetConfidences, into.confidence);
    reader.text("condition", into.condition, false);
}

void readGain(SheetReader& parent, InstrumentProfile& into) {
    const auto* object = parent.object("gain");
    if (object == nullptr) return;
    SheetReader reader(*object, parent.where() + ": gain");
    reader.only({"pct", "of", "condition", "source", "address", "confidence"});
    std::string of;
    reader.oneOf("of", kGainOf, of);
    reader.number("pct", kMaxPct, 1e-2, into.gain.value);
    readSheetSource(reader, into.gain);
    into.gainOfFullScale = of == "full scale";
    parent.take(reader.fault());
}

void readTimeBase(SheetReader& parent, InstrumentProfile& into) {
    const auto* object = parent.object("time_base");
    if (object == nullptr) return;
    SheetReader reader(*object, parent.where() + ": time_base");
    reader.only({"ppm", "ppm_per_year", "condition", "source", "address", "confidence"});
    reader.number("ppm", kMaxPpm, 1e-6, into.timeBase.value);
    reader.number("ppm_per_year", kMaxPpm, 1e-6, into.timeBase.perYear, false);
    readSheetSource(reader, into.timeBase);
    parent.take(reader.fault());
}

}  // namespace

bool InstrumentProfile::matches(std::string_view name) const {
    return std::ranges::any_of(makers, [&](const std::string& maker) {
        if (name.size() <= maker.size() || name[maker.size()] != ' ') return false;
        if (!sameLetters(maker, name.substr(0, maker.size()))) return false;
        const auto model = name.substr(maker.size() + 1);
        return std::ranges::any_of(models, [&](const std::string& pattern) { return modelMatches(pattern, model); });
    });
}

InstrumentStatement InstrumentProfile::statement() const {
    InstrumentStatement out;
    const auto by = "data sheet of the " + title;
    if (std::isfinite(gain.value)) {
        ChannelStatement channel;
        channel.gain = {gainOfFullScale ? 0 : gain.value, by};
        if (gainOfFullScale) channel.linearity = {gain.value, by};
        out.voltage = out.current = channel;
    }
    if (std::isfinite(timeBase.value)) out.timeBase = {timeBase.value + kYearsOfDrift * timeBase.perYear, by};
    return out;
}

Result<InstrumentProfile> parseInstrumentProfile(std::string_view json, std::string_view source) {
    const auto parsed = parseJson(json, source);
    if (!parsed) return failure(parsed);
    InstrumentProfile out;
    SheetReader reader(*parsed, std::string(source));
    reader.only({"id", "title", "makers", "models", "gain", "time_base", "note"});
    std::string note;
    reader.text("id", out.id);
    reader.text("title", out.title);
    reader.names("makers", false, out.makers);
    reader.names("models", true, out.models);
    reader.text("note", note, false);
    readGain(reader, out);
    readTimeBase(reader, out);
    if (reader.fault()) return tl::unexpected<Error>(*reader.fault());
    return out;
}

InstrumentStatement statementOf(const std::vector<InstrumentProfile>& profiles, std::string_view name) {
    const auto found =
        std::ranges::find_if(profiles, [&](const InstrumentProfile& profile) { return profile.matches(name); });
    return found == profiles.end() ? InstrumentStatement{} : found->statement();
}

}  // namespace tacto
