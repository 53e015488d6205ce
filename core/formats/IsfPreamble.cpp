#include "core/formats/IsfPreamble.h"

#include <cmath>
#include <optional>

#include "core/base/Text.h"
#include "core/formats/ChannelOptions.h"

namespace tacto {

namespace {

/// The long spelling and the shortest that instruments use; anything between is the same key.
struct Key {
    std::string_view full;
    std::string_view shortest;
};
constexpr Key kBytes{"byt_nr", "byt_n"};
constexpr Key kEncoding{"encdg", "enc"};
constexpr Key kNumbers{"bn_fmt", "bn_f"};
constexpr Key kOrder{"byt_or", "byt_o"};
constexpr Key kTitle{"wfid", "wfi"};
constexpr Key kPoints{"nr_pt", "nr_p"};
constexpr Key kPointFormat{"pt_fmt", "pt_f"};
constexpr Key kXUnit{"xunit", "xun"};
constexpr Key kXStep{"xincr", "xin"};
constexpr Key kXZero{"xzero", "xze"};
constexpr Key kPointOffset{"pt_off", "pt_o"};
constexpr Key kYUnit{"yunit", "yun"};
constexpr Key kYScale{"ymult", "ymu"};
constexpr Key kYOffset{"yoff", "yof"};
constexpr Key kYZero{"yzero", "yze"};

/// Where the samples begin: behind the last `CURV…` that is followed by a blank, and where that word begins.
struct Curve {
    std::size_t word;
    std::size_t behind;
};
std::optional<Curve> curveIn(std::string_view head) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    const std::string_view wanted = "curv";
    bool quoted = false;
    for (std::size_t i = 0; i + wanted.size() < head.size(); ++i) {
        if (head[i] == '"') quoted = !quoted;
        if (quoted || (i > 0 && head[i - 1] != ':' && head[i - 1] != ';')) continue;
        std::size_t matched = 0;
        while (matched < wanted.size() && lower(head[i + matched]) == wanted[matched]) ++matched;
        if (matched < wanted.size()) continue;
        std::size_t behind = i + matched;
        if (lower(head[behind]) == 'e') ++behind;
        while (behind < head.size() && head[behind] == ' ') ++behind;
        return Curve{i, behind};
    }
    return std::nullopt;
}

class Pairs {
public:
    explicit Pairs(std::string_view text) : text_(text) {}

    /// The value behind `key`, without quotes. Keys may have a path in front (":WFMPRE:BYT_NR").
    [[nodiscard]] std::optional<std::string_view> value(const Key& key) const {
        std::size_t at = 0;
        while (at < text_.size()) {
            std::size_t end = at;
            bool quoted = false;
            while (end < text_.size() && (quoted || text_[end] != ';')) quoted ^= text_[end++] == '"';
            const auto pair = trimmed(text_.substr(at, end - at));
            at = end + 1;
            const auto blank = pair.find(' ');
            if (blank == std::string_view::npos) continue;
            auto word = pair.substr(0, blank);
            if (const auto colon = word.rfind(':'); colon != std::string_view::npos) word.remove_prefix(colon + 1);
            const auto name = folded(word);
            if (!key.full.starts_with(name) || !name.starts_with(key.shortest)) continue;
            auto its = trimmed(pair.substr(blank));
            if (its.size() >= 2 && its.front() == '"' && its.back() == '"') its = its.substr(1, its.size() - 2);
            return its;
        }
        return std::nullopt;
    }

private:
    std::string_view text_;
};

}  // namespace

bool isIsf(std::string_view head) {
    const auto begin = folded(head.substr(0, 200));
    return begin.starts_with(":wfmp") || begin.starts_with(":wfmo") || begin.starts_with("wfmp") ||
           begin.starts_with("wfmo") || begin.starts_with("byt_n") || begin.starts_with(":curv");
}

Result<IsfPreamble> readIsfPreamble(std::string_view head, std::string_view file) {
    const auto curve = curveIn(head);
    if (!curve) {
        return fail(ErrorCode::ParseError, "{}: no :CURVE in the first {} bytes; the samples were expected behind it",
                    file, head.size());
    }
    const Pairs pairs(head.substr(0, curve->word));
    std::string wrong;  // the first complaint, so that the fields below read as a table
    const auto text = [&](const Key& key) { return folded(pairs.value(key).value_or("")); };
    const auto refuse = [&](const Key& key, std::string_view expected) {
        if (!wrong.empty()) return;
        const auto its = pairs.value(key);
        wrong = its ? fmt::format("{}: {} is '{}'; {} was expected", file, key.full, its->substr(0, 40), expected)
                    : fmt::format("{}: {} is missing; {} was expected", file, key.full, expected);
    };
    const auto number = [&](const Key& key, std::optional<double> otherwise = std::nullopt) {
        const auto its = pairs.value(key);
        const auto found = its ? parseNumber(*its) : otherwise;
        if (!found || !std::isfinite(*found)) refuse(key, "a number");
        return found.value_or(0);
    };
    IsfPreamble pre;
    pre.curve = curve->behind;
    const auto encoding = text(kEncoding);
    pre.text = encoding.starts_with("asc");
    if (!pre.text && !encoding.starts_with("bin")) refuse(kEncoding, "BINARY or ASCII");
    const double bytes = number(kBytes, 1);
    if (bytes != 1 && bytes != 2) refuse(kBytes, "1 or 2");
    pre.bytes = bytes == 2 ? 2 : 1;
    const auto numbers = text(kNumbers);
    pre.isSigned = numbers != "rp";
    if (!pre.text && numbers != "ri" && numbers != "rp") refuse(kNumbers, "RI or RP (integers)");
    const auto order = text(kOrder);
    pre.mostFirst = order != "lsb";
    if (!pre.text && pre.bytes == 2 && order != "msb" && order != "lsb") refuse(kOrder, "MSB or LSB");
    const double points = number(kPoints);
    if (!(points >= 2 && points <= 4e9) || points != std::floor(points)) refuse(kPoints, "a whole number from 2 on");
    const auto format = text(kPointFormat);
    if (!format.empty() && format != "y") refuse(kPointFormat, "Y, one value per point,");
    const auto unit = text(kXUnit);
    if (!unit.empty() && unit != "s") refuse(kXUnit, "s");
    pre.interval_s = number(kXStep);
    if (!(pre.interval_s > 0) || !std::isfinite(1 / pre.interval_s)) refuse(kXStep, "a time above 0");
    pre.start_s = number(kXZero, 0) - number(kPointOffset, 0) * pre.interval_s;
    pre.scale = number(kYScale);
    if (pre.scale == 0) refuse(kYScale, "a number other than 0");
    pre.offset = number(kYOffset);
    pre.zero = number(kYZero);
    if (!std::isfinite(pre.start_s)) refuse(kXZero, "a time within reason");
    if (!std::isfinite(pre.valueOf(-65536)) || !std::isfinite(pre.valueOf(65536)))
        refuse(kYScale, "a scale within reason");
    if (!wrong.empty()) return tl::unexpected<Error>(Error{ErrorCode::ParseError, std::move(wrong)});
    pre.points = static_cast<std::size_t>(points);
    pre.unit = pairs.value(kYUnit).value_or("");
    pre.title = pairs.value(kTitle).value_or("");
    return pre;
}

}  // namespace tacto
