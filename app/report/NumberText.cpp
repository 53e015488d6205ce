#include "app/report/NumberText.h"

#include <QJsonArray>
#include <QJsonObject>
#include <QRegularExpression>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/Printable.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"

namespace tacto {
namespace {

const QString kMissing = QStringLiteral("–");
const QString kSpace = QStringLiteral("\u202f");  // a narrow, non-breaking space
const QString kMinus = QStringLiteral("−");
constexpr double kMinInterval = 1e-6;  // smaller half-widths, relative to the value, are treated as none

QString shownUnit(const QString& unit) { return QString::fromStdString(writtenUnit(unit.toStdString())); }

struct Split {
    double factor = 1;  // from the given unit to the SI unit
    QString base;
    [[nodiscard]] UnitPrefix prefixFor(int exponent) const { return tacto::prefixFor(base.toStdString(), exponent); }
};

/// Splits "mA" into A and 1e-3, and "mA/cm²" likewise. For units without prefixes `base` is empty.
Split splitUnit(const QString& shown) {
    const auto parts = partsOfUnit(shown.toStdString());
    return {parts.factor, QString::fromStdString(parts.base)};
}

QString fixed(double value, int decimals) {
    QString text = QString::number(value, 'f', std::max(0, decimals));
    if (!text.startsWith('-')) return text;
    // A value that rounds to zero is written as zero, never as "−0.00".
    const bool zero = std::all_of(text.begin() + 1, text.end(), [](QChar c) { return c == '0' || c == '.'; });
    return text.replace(0, 1, zero ? QString() : QString(kMinus));
}

QString withUnit(const QString& number, const QString& unit) {
    return unit.isEmpty() ? number : number + kSpace + unit;
}

/// Returns the number as printed: with a true minus, and a narrow space before the unit.
QString onPage(const std::string& text, bool hasUnit) {
    QString shown = QString::fromStdString(text);
    shown.replace('-', kMinus);
    const qsizetype note = shown.indexOf(" (");
    const qsizetype space = shown.lastIndexOf(' ', note > 0 ? note - 1 : -1);
    if (hasUnit && space > 0) shown.replace(space, 1, kSpace);
    return shown;
}

}  // namespace

QString quantityText(double value, const QString& unit, int digits) {
    return onPage(scaledText(value, unit.toStdString(), digits), !unit.isEmpty());
}

QString quantityText(double value, double uncertainty, const QString& unit) {
    if (!std::isfinite(uncertainty)) return quantityText(value, unit);
    return uncertainText(value, std::abs(uncertainty), unit);
}

QString spreadText(double mean, double sd, const QString& unit) {
    return quantityText(mean, sd, unit).replace(" ± ", ", s.d. ");
}

QString uncertainText(double value, double expanded, const QString& unit) {
    return onPage(measuredText(value, expanded, unit.toStdString()), !unit.isEmpty());
}

QString intervalText(const Estimate& estimate, const QString& unit) {
    const auto [value, low, high] = estimate;
    const double half = (high - low) / 2;
    if (!std::isfinite(value) || !std::isfinite(half)) return quantityText(value, unit);
    const QString shown = shownUnit(unit);
    const Split split = splitUnit(shown);
    const double most = std::max({std::abs(value), std::abs(low), std::abs(high)}) * split.factor;
    const bool writtenOut = !split.base.isEmpty() || (most >= 1e-4 && most < 1e7);
    // An interval that is only rounding error does not decide the number of digits.
    if (!(half * split.factor > kMinInterval * most) || !writtenOut)
        return QString("%1 (%2 to %3)")
            .arg(quantityText(value, unit), quantityText(low, unit), quantityText(high, unit));
    const int last = decimalExponent(half * split.factor, 2) - 1;  // place of the last digit
    const auto prefix =
        split.base.isEmpty() ? UnitPrefix{} : split.prefixFor(std::max(decimalExponent(most, 4), last + 2));
    const double scale = split.factor * std::pow(10.0, -prefix.exponent);
    const auto number = [&](double one) { return onPage(decimalText(one * scale, prefix.exponent - last), false); };
    const QString inUnit = split.base.isEmpty() ? shown : prefix.symbol + split.base;
    return QString("%1 (%2 to %3)").arg(withUnit(number(value), inUnit), number(low), withUnit(number(high), inUnit));
}

QString settingText(double value, const QString& unit) {
    return onPage(exactText(value, unit.toStdString()), !unit.isEmpty());
}

QString toleranceText(double value, const QString& unit) {
    return settingText(std::isfinite(value) ? QString::number(value, 'g', 2).toDouble() : value, unit);
}

QString durationText(double seconds) {
    constexpr qint64 kMinute = 60, kHour = 3600, kMinutesFrom = 90;
    if (!std::isfinite(seconds)) return kMissing;
    const qint64 whole = std::llround(seconds);
    if (whole < kMinutesFrom) return QString("%1%2s").arg(whole).arg(kSpace);
    if (whole < kHour) return QString("%1%3min %2%3s").arg(whole / kMinute).arg(whole % kMinute).arg(kSpace);
    return QString("%1%3h %2%3min").arg(whole / kHour).arg(whole % kHour / kMinute).arg(kSpace);
}

QString proportionText(const Estimate& estimate) {
    const auto percent = [](double v) { return fixed(100 * v, 1); };
    if (!std::isfinite(estimate.value)) return kMissing;
    QString text = percent(estimate.value) + kSpace + "%";
    if (std::isfinite(estimate.low) && std::isfinite(estimate.high)) {
        text += QString(" (%1 to %2%3%)").arg(percent(estimate.low), percent(estimate.high), kSpace);
    }
    return text;
}

AxisUnit axisUnit(double maxAbs, const QString& unit) {
    const QString shown = shownUnit(unit);
    const Split split = splitUnit(shown);
    if (!(maxAbs > 0) || !std::isfinite(maxAbs) || split.base.isEmpty()) return {1, shown};
    const UnitPrefix prefix = split.prefixFor(decimalExponent(maxAbs * split.factor, 4));
    return {split.factor * std::pow(10.0, -prefix.exponent), prefix.symbol + split.base};
}

ColumnName columnName(const QString& key) {
    struct Suffix {
        const char* ending;
        const char* unit;
    };
    static constexpr std::array<Suffix, 21> kSuffixes{
        {{"_w_cm2", "W/cm²"}, {"_ma_cm2", "mA/cm²"}, {"_pct_fs", "% FS"}, {"_pct", "%"},   {"_ohm", "Ω"}, {"_v", "V"},
         {"_mv", "mV"},       {"_ma", "mA"},         {"_a", "A"},         {"_ms", "ms"},   {"_us", "µs"}, {"_s", "s"},
         {"_hz", "Hz"},       {"_uc", "µC"},         {"_mj", "mJ"},       {"_kpa", "kPa"}, {"_pa", "Pa"}, {"_n", "N"},
         {"_bits", "bit"},    {"_um", "µm"},         {"_g", "g"}}};
    ColumnName result;
    QString words = key;
    for (const auto& suffix : kSuffixes) {
        if (key.endsWith(QLatin1String(suffix.ending)) && key.size() > qsizetype(qstrlen(suffix.ending))) {
            result.unit = QString::fromUtf8(suffix.unit);
            words.chop(qsizetype(qstrlen(suffix.ending)));
            break;
        }
    }
    static const std::array<std::pair<const char*, const char*>, 12> known{{{"a", "Condition"},
                                                                            {"s", "s"},
                                                                            {"k", "k"},
                                                                            {"b", "Against"},
                                                                            {"n", "n"},
                                                                            {"mahalanobis", "Mahalanobis distance"},
                                                                            {"cv", "Coefficient of variation"},
                                                                            {"jnd", "Just-noticeable differences"},
                                                                            {"R", "R"},
                                                                            {"P", "P"},
                                                                            {"sd", "s.d."},
                                                                            {"p_chance", "p (chance)"}}};
    for (const auto& [name, title] : known) {
        if (words == QLatin1String(name)) {
            result.title = QString::fromUtf8(title);
            return result;
        }
    }
    words.replace('_', ' ');
    QStringList parts = words.split(' ', Qt::SkipEmptyParts);
    for (auto& part : parts) {
        if (part == "rms" || part == "dc" || part == "jnd" || part == "cv") part = part.toUpper();
        if (part == "1s") part = "1" + kSpace + "s";
        if (part == "5s") part = "5" + kSpace + "s";
    }
    result.title = parts.join(' ');
    if (!result.title.isEmpty()) result.title[0] = result.title[0].toUpper();
    return result;
}

std::optional<ColumnFormat> columnFormat(const std::vector<double>& values, const QString& unit) {
    const Split split = splitUnit(shownUnit(unit));
    double least = 0, most = 0;
    bool whole = true;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        whole = whole && value == std::floor(value);
        const double size = std::abs(value) * split.factor;
        if (size == 0) continue;
        least = least == 0 ? size : std::min(least, size);
        most = std::max(most, size);
    }
    if (most == 0 || most > 1000 * least || (whole && split.base.isEmpty())) return std::nullopt;
    if (split.base.isEmpty() && (most >= 1e7 || most < 1e-3)) return std::nullopt;
    const int exponent = decimalExponent(most, 4);
    const int prefix = split.base.isEmpty() ? 0 : split.prefixFor(exponent).exponent;
    // The smallest number keeps at least two digits; the largest has four.
    const int decimals = std::max(3 - (exponent - prefix), 1 - (decimalExponent(least, 2) - prefix));
    return ColumnFormat{prefix, std::clamp(decimals, 0, 6)};
}

QString quantityText(double value, const QString& unit, const ColumnFormat& format) {
    if (!std::isfinite(value)) return kMissing;
    const QString shown = shownUnit(unit);
    const Split split = splitUnit(shown);
    const double scaled = value * split.factor * std::pow(10.0, -format.exponent);
    return withUnit(fixed(scaled, format.decimals),
                    split.base.isEmpty() ? shown : prefixOf(format.exponent).symbol + split.base);
}

QString grouped(QString words) {
    static const QRegularExpression number(R"((?<![\w.])\d{5,})");
    for (auto at = number.match(words); at.hasMatch(); at = number.match(words, at.capturedEnd())) {
        auto digits = at.captured();
        for (auto i = digits.size() - 3; i > 0; i -= 3) digits.insert(i, QChar(0x202f));
        words.replace(at.capturedStart(), at.capturedLength(), digits);
    }
    return words;
}

QString withSigns(QString text) {
    static const QRegularExpression kHyphen(R"((^|[\s(\[])-(?=\d))"), kOhm(R"((\d)[ \x{a0}\x{202f}]?([kM]?)ohm\b)"),
        kSquare(R"(\b([cm]?m)2\b)");
    return text.replace(kHyphen, "\\1" + kMinus).replace(kOhm, "\\1" + kSpace + "\\2Ω").replace(kSquare, "\\1²");
}

namespace {

/// A cell with figures in one unit with a prefix, split into numbers and the text between them.
struct FigureCell {
    QString* text = nullptr;
    QString base;
    int exponent = 0;              // the prefix as a power of ten
    std::vector<QString> between;  // text between the numbers, one more than numbers, without the unit
    std::vector<QString> numbers;
    std::vector<bool> unitAfter;

    /// Returns the largest of the numbers, without a prefix.
    [[nodiscard]] double size() const {
        double most = 0;
        for (const auto& number : numbers) most = std::max(most, number.toDouble());
        return most * std::pow(10.0, exponent);
    }
    /// "0 V" is 0 in any prefix.
    [[nodiscard]] bool isZero() const { return numbers.size() == 1 && numbers.front() == "0"; }
    /// Returns the number times 10^`places`. Sets `padded` if zeros had to be added.
    static QString shifted(const QString& number, int places, bool& padded) {
        QString whole = number.section('.', 0, 0), part = number.section('.', 1);
        for (; places > 0; --places) {
            padded = padded || part.isEmpty();
            whole += part.isEmpty() ? QChar('0') : part[0];
            part.remove(0, 1);
        }
        for (; places < 0; ++places) {
            part.prepend(whole.isEmpty() ? QChar('0') : whole.back());
            whole.chop(1);
        }
        while (whole.size() > 1 && whole.startsWith('0')) whole.remove(0, 1);
        if (whole.isEmpty()) whole = "0";
        return part.isEmpty() ? whole : whole + '.' + part;
    }
    [[nodiscard]] QString in(int target, bool& padded) const {
        QString out = between.front();
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            out += isZero() ? numbers[i] : shifted(numbers[i], exponent - target, padded);
            if (unitAfter[i]) out += kSpace + prefixOf(target).symbol + base;
            out += between[i + 1];
        }
        return out;
    }
};

std::optional<FigureCell> figureCell(QString& text) {
    static const QRegularExpression kNumber(R"((\d+(?:\.\d+)?)(?:[ \x{a0}\x{202f}]([^\s\d(),;±<≤≥]+))?)"),
        kFiller(R"(^(?:[\s\x{a0}\x{202f}±()<≤≥,−-]|\bto\b|s\.d\.|U unknown|not judged)*$)");
    FigureCell cell{&text, {}, 0, {}, {}, {}};
    std::optional<QString> unit;
    qsizetype taken = 0;
    for (auto each = kNumber.globalMatch(text); each.hasNext();) {
        const auto match = each.next();
        const QString word = match.captured(2);
        const Split split = splitUnit(word);
        const bool isUnit = !split.base.isEmpty();
        if (isUnit && unit && *unit != word) return {};
        if (isUnit && !unit) {
            unit = word;
            cell.base = split.base;
            cell.exponent = static_cast<int>(std::lround(std::log10(split.factor)));
        }
        cell.between.push_back(text.mid(taken, match.capturedStart(1) - taken));
        cell.numbers.push_back(match.captured(1));
        cell.unitAfter.push_back(isUnit);
        taken = isUnit ? match.capturedEnd(2) : match.capturedEnd(1);
    }
    cell.between.push_back(text.mid(taken));
    const bool plain =
        std::ranges::all_of(cell.between, [](const QString& part) { return kFiller.match(part).hasMatch(); });
    if (!unit || !plain) return {};
    return cell;
}

}  // namespace

void sharePrefix(const std::vector<QString*>& cells) {
    constexpr qsizetype kMuchShorter = 6;  // characters
    constexpr double kOnePrefix = 1000;    // largest over smallest with one prefix
    std::vector<FigureCell> figures;
    for (auto* cell : cells) {
        if (auto figure = figureCell(*cell)) figures.push_back(*std::move(figure));
    }
    while (!figures.empty()) {
        const QString base = figures.front().base;
        const auto same = std::stable_partition(figures.begin(), figures.end(),
                                                [&](const FigureCell& each) { return each.base == base; });
        double most = 0;
        for (auto each = figures.begin(); each != same; ++each) most = std::max(most, each->size());
        // 100 µs in a column of 2 s keeps a prefix with its like.
        const auto others = std::stable_partition(figures.begin(), same, [&](const FigureCell& each) {
            return each.isZero() || each.size() * kOnePrefix >= most;
        });
        std::vector<int> prefixes;
        for (auto each = figures.begin(); each != others; ++each)
            if (!each->isZero()) prefixes.push_back(each->exponent);
        std::ranges::sort(prefixes, std::greater());
        prefixes.erase(std::ranges::unique(prefixes).begin(), prefixes.end());
        int chosen = prefixes.empty() ? 0 : prefixes.front();
        std::optional<qsizetype> shortest;
        for (const int prefix : prefixes) {
            qsizetype longest = 0;
            bool padded = false;
            for (auto each = figures.begin(); each != others; ++each)
                longest = std::max(longest, each->in(prefix, padded).size());
            if (shortest && (padded || longest + kMuchShorter > *shortest)) continue;
            shortest = longest;
            chosen = prefix;
        }
        bool ignored = false;
        for (auto each = figures.begin(); each != others; ++each)
            if (each->exponent != chosen) *each->text = each->in(chosen, ignored);
        figures.erase(figures.begin(), others);
    }
}

void useOneUnit(const std::vector<QString*>& cells) {
    std::vector<FigureCell> figures;
    const FigureCell* largest = nullptr;
    for (auto* cell : cells)
        if (auto figure = figureCell(*cell)) figures.push_back(*std::move(figure));
    for (const auto& figure : figures)
        if (largest == nullptr || figure.size() > largest->size()) largest = &figure;
    for (const auto& figure : figures) {
        bool padded = false;
        if (figure.base == largest->base) *figure.text = figure.in(largest->exponent, padded);
    }
}

void sharePrefix(QStringList& cells) {
    std::vector<QString*> all;
    for (auto& cell : cells) all.push_back(&cell);
    sharePrefix(all);
}

bool isFigure(const QString& text) {
    static const QRegularExpression kFigure(
        R"(^(± )?[−-]?\d+(\.\d+)?((?: ±|, s\.d\.) \d+(\.\d+)?)?([ \x{202f}\x{a0}]?[^\d\s−-][^\d\s]{0,7})?$)",
        QRegularExpression::UseUnicodePropertiesOption);
    return kFigure.match(text).hasMatch();
}

QString takeUnit(QStringList& cells) {
    static const QRegularExpression kLastNumber(R"(^(.*\d)([^\d]+)$)"), kDigit("\\d");
    std::optional<QString> shared;
    for (const auto& cell : cells) {
        if (!cell.contains(kDigit)) continue;
        const auto found = kLastNumber.match(cell);
        if (!found.hasMatch() || !isFigure(cell)) return {};
        if (!shared) shared = found.captured(2);
        if (found.captured(2) != *shared) return {};
    }
    if (!shared) return {};
    for (auto& cell : cells) {
        if (cell.endsWith(*shared)) cell.chop(shared->size());
    }
    return shared->trimmed();
}

void alignPoints(QStringList& cells) {
    static const QRegularExpression kNumber(R"(\d+(\.\d+)?)");
    const QString digit(QChar(0x2007)), point(QChar(0x2008));
    const auto between = [](const QString& cell) { return QString(cell).remove(kNumber).remove(kMinus); };
    std::optional<QString> like;
    std::vector<qsizetype> most;  // for each number of a cell, the most decimals in the column
    for (const auto& cell : cells) {
        std::size_t n = 0;
        for (auto each = kNumber.globalMatch(cell); each.hasNext(); ++n) {
            const qsizetype places = std::max<qsizetype>(0, each.next().capturedLength(1) - 1);
            if (n >= most.size()) most.push_back(places);
            most[n] = std::max(most[n], places);
        }
        if (n == 0) continue;
        if (!like) like = between(cell);
        if (between(cell) != *like || like->contains(',')) return;  // a comma directly follows its number
    }
    for (auto& cell : cells) {
        QString filled;
        qsizetype taken = 0;
        std::size_t n = 0;
        for (auto each = kNumber.globalMatch(cell); each.hasNext(); ++n) {
            const auto number = each.next();
            const qsizetype places = std::max<qsizetype>(0, number.capturedLength(1) - 1);
            filled += cell.mid(taken, number.capturedEnd() - taken);
            if (places < most[n]) filled += (places == 0 ? point : QString()) + digit.repeated(most[n] - places);
            taken = number.capturedEnd();
        }
        cell = filled + cell.mid(taken);
    }
}

QString visible(const QString& text) {
    auto codes = text.toUcs4();
    for (auto& code : codes) {
        const bool movesCursor = isControl(code) && code != '\n' && code != '\t';
        if (movesCursor || isHidden(code)) code = QChar::ReplacementCharacter;
    }
    return QString::fromUcs4(reinterpret_cast<const char32_t*>(codes.constData()), codes.size());
}

QString cellText(const QJsonValue& value, const QString& unit) {
    if (value.isDouble()) return quantityText(value.toDouble(), unit);
    if (value.isString()) return value.toString();
    if (value.isBool()) return value.toBool() ? "yes" : "no";
    if (value.isArray()) {
        QStringList parts;
        for (const auto& element : value.toArray()) parts << cellText(element, unit);
        return parts.join(", ");
    }
    if (value.isObject()) {
        const auto object = value.toObject();
        if (object.contains("mean")) {
            return spreadText(object["mean"].toDouble(kNaN), object["sd"].toDouble(kNaN), unit);
        }
        if (object.contains("expanded")) {
            return uncertainText(object["value"].toDouble(kNaN), object["expanded"].toDouble(kNaN),
                                 object["unit"].toString(unit));
        }
        if (object.contains("value") && object.contains("unit")) {
            return quantityText(object["value"].toDouble(kNaN), object["unit"].toString());
        }
        if (object.contains("value")) {
            return intervalText(
                {object["value"].toDouble(kNaN), object["low"].toDouble(kNaN), object["high"].toDouble(kNaN)}, unit);
        }
    }
    return kMissing;
}

}  // namespace tacto
