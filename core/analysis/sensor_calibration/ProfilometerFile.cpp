#include "core/analysis/sensor_calibration/ProfilometerFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

std::string_view withoutQuotes(std::string_view field) {
    field = trimmed(field);
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
        field = trimmed(field.substr(1, field.size() - 2));
    }
    return field;
}

/// Returns micrometres per unit if the text is only a unit, with or without brackets.
std::optional<double> unitOf(std::string_view text) {
    text = withoutQuotes(text);
    if (text.size() >= 2 && (text.front() == '[' || text.front() == '(') &&
        (text.back() == ']' || text.back() == ')')) {
        text = trimmed(text.substr(1, text.size() - 2));
    }
    const auto is = [&](std::string_view name) { return text == name; };
    // Micro in UTF-8 (sign and Greek letter), in Latin-1, and as usually typed.
    for (const auto* name :
         {"\xC2\xB5m", "\xCE\xBCm", "\xB5m", "um", "micron", "microns", "micrometer", "micrometre"}) {
        if (is(name)) return 1.0;
    }
    if (is("nm")) return 1e-3;
    if (is("mm")) return 1e3;
    return std::nullopt;
}

struct Number {
    double value = 0;
    std::optional<double> unit;  // the unit after the number
};

/// Reads "1.62", "1,62", "1.62 µm".
std::optional<Number> numberOf(std::string_view text) {
    text = withoutQuotes(text);
    std::size_t end = 0;
    while (end < text.size() && std::string_view("0123456789.,+-eE").find(text[end]) != std::string_view::npos) ++end;
    std::string digits(text.substr(0, end));
    if (std::count(digits.begin(), digits.end(), ',') == 1 && digits.find('.') == std::string::npos) {
        std::replace(digits.begin(), digits.end(), ',', '.');
    }
    const auto value = parseNumber(digits);
    if (!value || digits.empty()) return std::nullopt;
    Number out{*value, std::nullopt};
    const auto rest = trimmed(text.substr(end));
    if (rest.empty()) return out;
    out.unit = unitOf(rest);
    if (!out.unit) return std::nullopt;
    return out;
}

enum class Parameter : std::size_t { Ra, Rz };

/// A field with the name Ra or Rz, and the other content of the field.
struct Label {
    Parameter parameter;
    std::optional<double> unit;
    std::optional<Number> value;
};

std::optional<Label> labelOf(std::string_view field) {
    field = withoutQuotes(field);
    const auto name = lowered(field.substr(0, 2));
    if (name != "ra" && name != "rz") return std::nullopt;
    Label out{name == "ra" ? Parameter::Ra : Parameter::Rz, std::nullopt, std::nullopt};
    auto rest = field.substr(2);
    if (!rest.empty() && std::string_view(" \t=:[(").find(rest.front()) == std::string_view::npos) return std::nullopt;
    rest = trimmed(rest);
    if (!rest.empty() && (rest.front() == '[' || rest.front() == '(')) {
        const auto close = rest.find_first_of("])");
        if (close == std::string_view::npos) return std::nullopt;
        out.unit = unitOf(rest.substr(0, close + 1));
        if (!out.unit) return std::nullopt;  // "Ra (limit)" is not Ra itself
        rest = trimmed(rest.substr(close + 1));
    }
    if (!rest.empty() && (rest.front() == '=' || rest.front() == ':')) rest = trimmed(rest.substr(1));
    if (rest.empty()) return out;
    if (const auto unit = unitOf(rest)) {
        out.unit = unit;
        return out;
    }
    out.value = numberOf(rest);
    if (!out.value) return std::nullopt;
    return out;
}

std::vector<std::string_view> fieldsOf(std::string_view line, char separator) {
    // In a file without other separators, "Ra = 1,62 µm" or "Ra: 1,62 µm" is a single field.
    if (separator == ',' && line.find_first_of("=:") != std::string_view::npos && labelOf(line)) return {line};
    std::vector<std::string_view> out;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') quoted = !quoted;
        if (quoted || line[i] != separator) continue;
        out.push_back(line.substr(begin, i - begin));
        begin = i + 1;
    }
    out.push_back(line.substr(begin));
    return out;
}

bool beginsWith(std::string_view field, std::initializer_list<std::string_view> words) {
    auto word = lowered(withoutQuotes(field));
    const auto end = std::find_if(word.begin(), word.end(), [](char c) { return c == ' ' || c == '.' || c == ':'; });
    word.erase(end, word.end());
    return std::find(words.begin(), words.end(), word) != words.end();
}

class Search {
public:
    Search(std::string_view source, char separator) : source_(source), separator_(separator) {}

    Result<void> line(std::string_view text, std::size_t number) {
        line_ = number;
        const auto fields = fieldsOf(text, separator_);
        bool labelled = false;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const auto label = labelOf(fields[i]);
            if (!label) continue;
            if (!labelled) columns_ = {};  // new header or block, so the old table has ended
            labelled = true;
            if (auto taken = take(*label, fields, i); !taken) return taken;
        }
        return labelled ? Result<void>() : row(fields);
    }

    Result<ProfilometerReading> finish(std::size_t lines) const {
        const auto ra = of(Parameter::Ra), rz = of(Parameter::Rz);
        if (ra.values.empty()) {
            if (nameSeen_ != 0) {
                return fail(ErrorCode::ParseError,
                            "{}, line {}: Ra is named but no value follows; a number with nm, "
                            "µm or mm is expected",
                            source_, nameSeen_);
            }
            return fail(ErrorCode::ParseError,
                        "{}, line {}: the file ends without Ra; a line such as \"Ra;1.62;µm\" is expected", source_,
                        lines);
        }
        const auto mean = [](const std::vector<double>& values) {
            double sum = 0;
            for (const double value : values) sum += value;
            return sum / static_cast<double>(values.size());
        };
        ProfilometerReading out;
        out.ra_um = mean(ra.values);
        out.raValues = ra.values.size();
        if (rz.values.empty()) return out;
        out.rz_um = mean(rz.values);
        out.rzValues = rz.values.size();
        if (!(out.rz_um >= out.ra_um)) {
            return fail(ErrorCode::ParseError, "{}, line {}: Rz is {} µm; at least Ra, {} µm, is expected", source_,
                        rz.line, out.rz_um, out.ra_um);
        }
        return out;
    }

private:
    struct Found {
        std::vector<double> values;  // µm
        std::size_t line = 0;        // number of the last line
        bool final = false;          // true if a row of means was found; it is final
    };
    struct Column {
        std::optional<std::size_t> index;
        std::optional<double> unit;
    };

    [[nodiscard]] const Found& of(Parameter parameter) const { return found_[static_cast<std::size_t>(parameter)]; }

    static const char* nameOf(Parameter parameter) { return parameter == Parameter::Ra ? "Ra" : "Rz"; }

    Result<void> add(Parameter parameter, const Number& number, std::optional<double> unit, bool final) {
        auto& found = found_[static_cast<std::size_t>(parameter)];
        if (found.final) return {};
        const auto used = number.unit ? number.unit : unit;
        if (!used) {
            return fail(ErrorCode::ParseError, "{}, line {}: {} is {} without a unit; nm, µm or mm is expected",
                        source_, line_, nameOf(parameter), number.value);
        }
        const double um = number.value * *used;
        if (!(um > 0) || !std::isfinite(um)) {
            return fail(ErrorCode::ParseError, "{}, line {}: {} is {} µm; a value above 0 is expected", source_, line_,
                        nameOf(parameter), um);
        }
        if (final) found.values.clear();
        found.final = final;
        found.values.push_back(um);
        found.line = line_;
        return {};
    }

    Result<void> take(const Label& label, const std::vector<std::string_view>& fields, std::size_t at) {
        if (label.parameter == Parameter::Ra) nameSeen_ = line_;
        if (label.value) return add(label.parameter, *label.value, label.unit, false);
        const auto next = at + 1 < fields.size() ? fields[at + 1] : std::string_view();
        const auto unit = label.unit ? label.unit : unitOf(next);
        // Accepts name, unit, value and name, value, unit.
        const std::size_t valueAt = unitOf(next) ? at + 2 : at + 1;
        const auto value = valueAt < fields.size() ? numberOf(fields[valueAt]) : std::nullopt;
        if (!value) {
            columns_[static_cast<std::size_t>(label.parameter)] = {at, label.unit};
            return {};
        }
        const auto after = valueAt + 1 < fields.size() ? fields[valueAt + 1] : std::string_view();
        const auto second = numberOf(after);
        if (separator_ == ',' && second && second->value >= 0 && second->value == std::floor(second->value) &&
            value->value == std::floor(value->value) && !value->unit) {
            return fail(ErrorCode::ParseError,
                        "{}, line {}: {} reads {},{}, which may be one number or two; a decimal point, quotes or "
                        "semicolons between the fields are expected",
                        source_, line_, nameOf(label.parameter), withoutQuotes(fields[valueAt]), withoutQuotes(after));
        }
        return add(label.parameter, *value, unit ? unit : unitOf(after), false);
    }

    Result<void> row(const std::vector<std::string_view>& fields) {
        if (beginsWith(fields.front(), {"sd", "s", "std", "stdev", "sigma", "min", "minimum", "max", "maximum", "range",
                                        "cv", "tolerance", "limit"})) {
            return {};
        }
        const bool mean = beginsWith(fields.front(), {"mean", "average", "avg", "mittelwert", "moyenne"});
        for (const auto parameter : {Parameter::Ra, Parameter::Rz}) {
            auto& column = columns_[static_cast<std::size_t>(parameter)];
            if (!column.index || *column.index >= fields.size()) continue;
            const auto field = fields[*column.index];
            if (const auto unit = unitOf(field)) {
                column.unit = unit;
            } else if (const auto number = numberOf(field)) {
                if (auto added = add(parameter, *number, column.unit, mean); !added) return added;
            }
        }
        return {};
    }

    const std::string_view source_;
    const char separator_;
    std::array<Found, 2> found_;
    std::array<Column, 2> columns_;
    std::size_t line_ = 0;
    std::size_t nameSeen_ = 0;  // line that names Ra, even without a value
};

}  // namespace

Result<ProfilometerReading> parseProfilometer(std::string_view text, std::string_view source) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        return fail(ErrorCode::ParseError, "{}, line 1: the text is UTF-16; UTF-8 or Latin-1 is expected", source);
    }
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const char separator = text.find(';') != std::string_view::npos    ? ';'
                           : text.find('\t') != std::string_view::npos ? '\t'
                                                                       : ',';
    Search search(source, separator);
    std::size_t number = 0;
    for (auto line : split(text, '\n')) {
        ++number;
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (trimmed(line).empty()) continue;
        if (auto read = search.line(line, number); !read) return failure(read);
    }
    return search.finish(number);
}

Result<ProfilometerReading> readProfilometer(const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) {
        return fail(ErrorCode::NotFound, "{}: no such file; a profilometer's CSV is expected", path.string());
    }
    std::ifstream in(path, std::ios::binary);
    std::string text(kLargestProfilometerFile + 1, '\0');
    if (!in.read(text.data(), static_cast<std::streamsize>(text.size())) && !in.eof()) {
        return fail(ErrorCode::Io, "{} cannot be read; a profilometer's CSV is expected", path.string());
    }
    const auto bytes = static_cast<std::size_t>(in.gcount());
    if (bytes > kLargestProfilometerFile) {
        return fail(ErrorCode::ParseError,
                    "{}: more than {} MiB; a profilometer's results, not its raw profile, are "
                    "expected",
                    path.string(), kLargestProfilometerFile >> 20U);
    }
    text.resize(bytes);
    return parseProfilometer(text, path.string());
}

}  // namespace tacto
