#include "app/report/ResultCells.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/report/NumberText.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/base/JsonText.h"
#include "core/base/QuantityText.h"
#include "core/encoding/StimulatorCalibration.h"
#include "core/kinds/ResultKinds.h"
#include "core/safety/LimitSet.h"

namespace tacto {

namespace {

using nlohmann::json;
using As = ResultColumn::As;
using Shape = ResultTable::Shape;

constexpr double kOnePrefix = 1e4;        // numbers further apart than this factor each get their own prefix
constexpr double kOnePrefixWithU = 1000;  // the same for numbers with an uncertainty, which show all its decimals
constexpr int kDigits = 4, kSpreadDigits = 2;
const QString kNone = QStringLiteral("–");

/// A number of a record with its uncertainty and bounds.
struct Known {
    double value = std::nan("");
    double around = std::nan("");  ///< expanded uncertainty, or a standard deviation
    double low = std::nan("");
    double high = std::nan("");
    bool hasAround = false;
    double bound = std::nan("");  ///< one-sided
};

QString textOf(const json& value) {
    if (value.is_string()) return visible(QString::fromStdString(value.get<std::string>()));
    if (value.is_boolean()) return value.get<bool>() ? QObject::tr("yes") : QObject::tr("no");
    if (value.is_number()) return settingText(value.get<double>(), {});
    if (!value.is_array() || value.empty()) return kNone;
    QStringList parts;
    for (const auto& each : value)
        parts << (each.is_number()       ? quantityText(each.get<double>(), {})
                  : each.is_structured() ? kNone
                                         : textOf(each));
    return parts.join(", ");
}

QString unitOf(const ResultColumn& column) { return QString::fromStdString(column.unit); }
QString titleOf(const ResultColumn& column) { return QString::fromStdString(column.title); }

Known knownOf(const ResultColumn& column, const json& record) {
    const auto minus = column.at.find('-');
    const auto& value = memberAt(record, column.at.substr(0, minus));
    Known known;
    known.value = numberOr(value);
    if (minus != std::string::npos) known.value -= numberOr(memberAt(record, column.at.substr(minus + 1)));
    if (value.is_object()) {
        const bool spread = value.contains("mean") || value.contains("sd");
        known.value = numberOr(memberAt(value, value.contains("mean")     ? "mean"
                                               : value.contains("median") ? "median"
                                                                          : "value"));
        known.hasAround = spread;
        if (spread) known.around = numberOr(memberAt(value, "sd"));
        known.low = spread ? std::nan("") : numberOr(memberAt(value, "low"));
        known.high = spread ? std::nan("") : numberOr(memberAt(value, "high"));
    }
    if (column.beside.empty()) return known;
    const double beside = numberOr(memberAt(record, column.beside));
    if (column.as == As::Share || column.as == As::AtLeast) {
        known.bound = beside;
    } else {
        known.hasAround = true;
        known.around = beside;
    }
    return known;
}

/// Returns one number in `unit`. If not `isU`, the second number is a standard deviation, which may be unknown.
QString numberText(const Known& known, const QString& unit, bool isU, int digits = kDigits) {
    if (!std::isfinite(known.value)) return kNone;
    if (known.hasAround)
        return isU ? uncertainText(known.value, known.around, unit) : spreadText(known.value, known.around, unit);
    if (std::isfinite(known.low) && std::isfinite(known.high))
        return intervalText({known.value, known.low, known.high}, unit);
    return quantityText(known.value, unit, digits);
}

QString decimalText(double value, int decimals) {
    return QString::fromStdString(tacto::decimalText(value, decimals)).replace('-', QChar(0x2212));
}

/// Puts the part in brackets on a second line, even if it is not a unit: "Smallest pair (JND)".
QString onTwoLines(QString title) {
    if (const auto at = title.lastIndexOf(" ("); at > 0 && title.endsWith(')')) title[at] = '\n';
    return title;
}

QString headed(const QString& title, const QString& unit) {
    return unit.isEmpty() ? title : QString("%1\n(%2)").arg(title, unit);
}

void scale(Known& known, double factor) {
    for (auto* number : {&known.value, &known.around, &known.low, &known.high, &known.bound}) *number *= factor;
}

/// Returns "0.26, at most 0.75"; a bound that is required but missing is stated as unknown.
QString boundedText(const QString& value, const char* most, double bound, const QString& shown) {
    return QObject::tr("%1, %2 %3")
        .arg(value, QObject::tr(most), std::isfinite(bound) ? shown : QObject::tr("unknown"));
}

ColumnText sharesText(const ResultColumn& column, const json& records) {
    ColumnText out{headed(titleOf(column), "%"), {}, true};
    for (const auto& record : records) {
        auto known = knownOf(column, record);
        scale(known, 100);
        const auto tenth = [](double value) { return decimalText(value, 1); };
        const auto brief = [](double value) { return quantityText(value, {}, kSpreadDigits); };
        if (!std::isfinite(known.value))
            out.cells << kNone;
        else if (!column.beside.empty())
            out.cells << boundedText(brief(known.value), "at most", known.bound, brief(known.bound));
        else if (std::isfinite(known.low) && std::isfinite(known.high))
            out.cells << QObject::tr("%1 (%2 to %3)").arg(tenth(known.value), tenth(known.low), tenth(known.high));
        else
            out.cells << numberText(known, {}, true);
    }
    return out;
}

/// Returns distances, with their bound if the column has one.
ColumnText distancesText(const ResultColumn& column, const json& records) {
    ColumnText out{onTwoLines(titleOf(column)), {}, true};
    const auto hundredth = [](double value) { return decimalText(value, 2); };
    for (const auto& record : records) {
        const auto known = knownOf(column, record);
        if (!std::isfinite(known.value))
            out.cells << kNone;
        else if (column.as == As::AtLeast)
            out.cells << boundedText(hundredth(known.value), "at least", known.bound, hundredth(known.bound));
        else
            out.cells << hundredth(known.value);
    }
    return out;
}

ColumnText numbersText(const ResultColumn& column, const json& records) {
    ColumnText out{titleOf(column), {}, true};
    const bool isU = !column.beside.empty();
    const auto unit = unitOf(column);
    const int digits = column.as == As::Spread ? kSpreadDigits : kDigits;
    std::vector<Known> all;
    std::vector<double> values;
    double least = 0, most = 0;
    for (const auto& record : records) {
        all.push_back(knownOf(column, record));
        values.push_back(all.back().value);
        const double size = std::abs(all.back().value);
        const double seen =
            all.back().hasAround && std::isfinite(all.back().around) ? std::max(size, all.back().around) : size;
        if (!std::isfinite(seen) || seen == 0) continue;
        least = least == 0 ? seen : std::min(least, seen);
        most = std::max(most, seen);
    }
    const bool own = unit.startsWith('@');
    const bool around =
        std::any_of(all.begin(), all.end(), [](const Known& k) { return k.hasAround || std::isfinite(k.low); });
    const bool apart = most > (around ? kOnePrefixWithU : kOnePrefix) * least;
    const auto axis = axisUnit(most, own ? QString() : unit);
    const auto format = columnFormat(values, unit);
    for (std::size_t row = 0; row < all.size(); ++row) {
        auto& known = all[row];
        if (own) {
            const auto said = memberAt(records[row], column.unit.substr(1));
            out.cells << numberText(known, said.is_string() ? textOf(said) : QString(), isU, digits);
        } else if (apart && !unit.isEmpty()) {
            out.cells << numberText(known, unit, isU, digits);
        } else if (!around && digits == kDigits && format && std::isfinite(known.value)) {
            out.cells << quantityText(known.value, unit, *format).section(QChar(0x202f), 0, 0);
        } else {
            scale(known, axis.factor);
            out.cells << numberText(known, {}, isU, digits);
        }
    }
    if (own) sharePrefix(out.cells);
    for (auto& cell : out.cells) cell = grouped(std::move(cell));
    out.header =
        !own && !apart && !axis.unit.isEmpty() ? headed(titleOf(column), axis.unit) : onTwoLines(titleOf(column));
    return out;
}

ColumnText usedText(const ResultColumn& column, const json& records) {
    ColumnText out{titleOf(column), {}, true};
    for (const auto& record : records) {
        double used = numberOr(memberAt(record, column.at));
        if (!column.beside.empty())
            used = (std::abs(used) + numberOr(memberAt(record, column.beside))) /
                   numberOr(memberAt(record, column.unit.substr(1)));
        out.cells << limitShareText(100 * used);
    }
    return out;
}

ColumnText tolerancesText(const ResultColumn& column, const json& records) {
    ColumnText out{titleOf(column), {}, true};
    for (const auto& record : records) {
        const auto& value = memberAt(record, column.at);
        out.cells << (value.is_number() ? toleranceText(value.get<double>(), unitOf(column)) : kNone);
    }
    return out;
}

QString wordsText(As as, const json& value) {
    if (value.is_null()) return as == As::Freedom ? QStringLiteral("∞") : kNone;
    const auto text = textOf(value);
    switch (as) {
        case As::Verdict:
            if (value.is_boolean()) return wordsText(as, value.get<bool>() ? "pass" : "fail");
            return text.isEmpty() ? kNone : verdictCell(text).replace(QChar(0x00a0), ' ');
        case As::Load:
            return loadText(text);
        case As::LimitSet:
            return limitSetTitle(text);
        case As::Quantity: {
            const auto* known = calibratedQuantity(text.toStdString());
            return known != nullptr ? QString::fromStdString(std::string(known->title)) : text;
        }
        case As::Condition:
            return QString::fromStdString(answerWords(text.toStdString())).replace('-', ' ');
        case As::Chance:
            return QString::fromStdString(chanceText(numberOr(value)));
        case As::Heading:
            return QString(text).replace(0, 1, text.left(1).toUpper());
        case As::Freedom:
            return decimalText(numberOr(value), 0);
        default:
            return text.isEmpty() ? kNone : withSigns(text);
    }
}

bool isCell(const nlohmann::json& value) {
    return value.is_primitive() || (value.is_object() && (value.contains("mean") || value.contains("value")));
}

/// Returns a column for a member that no schema describes.
ResultColumn guessed(const std::string& key, const nlohmann::json& value) {
    const auto name = columnName(QString::fromStdString(key));
    const bool counts = value.is_number() || value.is_object();
    const auto kind = key == "verdict" ? As::Verdict : counts ? As::Number : As::Text;
    return {name.title.toStdString(), key, kind, name.unit.toStdString()};
}

std::vector<ResultColumn> columnsIn(const nlohmann::json& records) {
    std::vector<ResultColumn> columns;
    for (const auto& record : records) {
        for (const auto& [key, value] : record.items()) {
            const bool has = std::any_of(columns.begin(), columns.end(),
                                         [&wanted = key](const ResultColumn& column) { return column.at == wanted; });
            if (!has && isCell(value)) columns.push_back(guessed(key, value));
        }
    }
    // A JSON object does not keep its order, so members that name a record are put first.
    static const std::vector<std::string> first{"name", "condition", "load", "a", "b", "n"};
    std::stable_sort(columns.begin(), columns.end(), [](const ResultColumn& one, const ResultColumn& other) {
        const auto rank = [](const ResultColumn& c) { return std::find(first.begin(), first.end(), c.at); };
        return rank(one) < rank(other);
    });
    return columns;
}

}  // namespace

QString limitSetTitle(const QString& id) {
    const auto text = id.toStdString();
    return QString::fromStdString(std::string(shortTitleOf(text)));
}

QString limitText(const json& line) {
    const double limit = numberOr(line, "limit");
    if (!std::isfinite(limit)) return {};
    const QString sign = textOr(line, "compare") == "<" ? "< " : "≤ ";
    return sign + settingText(limit, visible(QString::fromStdString(textOr(line, "unit"))));
}

QString limitShareText(double used_pct) {
    if (!std::isfinite(used_pct)) return "–";
    if (used_pct > 0 && used_pct < 0.1) return "<\u202f0.1\u202f%";
    return QString::number(used_pct, 'f', used_pct < 1 && used_pct > 0 ? 1 : 0) + "\u202f%";
}

QString loadText(QString name) {
    static const QRegularExpression between("(\\d) (?=[kM]?Ω|[npuµ]F)");  // a number stays with its unit
    return name.replace("ohm", "Ω").replace("||", "∥").replace(between, QString("\\1") + QChar(0x00a0));
}

QString verdictShape(const QString& key) {
    static const std::map<QString, QString> kShapes{{"pass", "✔"},          {"fail", "✖"},
                                                    {"indeterminate", "?"}, {"stopped", "■"},
                                                    {"attention", "▲"},     {"refused as expected", "⊘"},
                                                    {"not evaluated", "○"}};
    return kShapes.contains(key) ? kShapes.at(key) : kNone;
}

QString verdictCell(const QString& key) {
    const auto shape = verdictShape(key);
    return shape != kNone || key == "not applicable" ? shape + QChar(0x00a0) + key : key;
}

QStringList sentencesIn(const json& value) {
    QStringList texts;
    for (const auto& one : value.is_string() ? json::array({value}) : value) {
        if (one.is_string()) texts << withSigns(visible(QString::fromStdString(one.get<std::string>())));
    }
    return texts;
}

CountsText countsText(const ResultTable& table, const json& results) {
    CountsText out;
    const auto& conditions = memberAt(results, "conditions");
    const auto as = conditions.is_array() ? As::Text : As::Condition;
    const auto namesIn = [as](const json& list) {
        QStringList names;
        for (const auto& each : list) names << wordsText(as, each.is_object() ? memberAt(each, "name") : each);
        return names;
    };
    out.down = namesIn(conditions.is_array() ? conditions : memberAt(results, "labels"));
    out.across = namesIn(memberAt(results, "columns"));
    if (out.across.isEmpty()) out.across = out.down;
    for (const auto& row : memberAt(results, table.at)) {
        QStringList counts;
        for (const auto& count : row) counts << (count.is_number() ? settingText(count.get<double>(), {}) : kNone);
        if (counts.size() != out.across.size()) return {};
        out.counts.push_back(std::move(counts));
    }
    return qsizetype(out.counts.size()) == out.down.size() ? out : CountsText();
}

std::vector<ResultTable> tablesOf(const json& results) {
    const auto& kind = memberAt(results, "kind");
    const auto& known = resultTraits(kind.is_string() ? kind.get<std::string>() : std::string());
    return known.tables.empty() ? tablesIn(results) : known.tables;
}

ColumnText columnText(const ResultColumn& column, const json& records) {
    if (column.as == As::Share) return sharesText(column, records);
    if (column.as == As::Jnd || column.as == As::AtLeast) return distancesText(column, records);
    if (column.as == As::Used) return usedText(column, records);
    if (column.as == As::Number || column.as == As::Spread) return numbersText(column, records);
    if (column.as == As::Tolerance) return tolerancesText(column, records);
    if (column.as == As::Limit) {
        ColumnText limits{titleOf(column), {}, false};
        for (const auto& record : records) {
            const auto text = limitText(record);
            limits.cells << (text.isEmpty() ? QObject::tr(kUntilNextTrain) : text);
        }
        return limits;
    }
    ColumnText out{titleOf(column), {}, column.as == As::Chance || column.as == As::Freedom};
    for (const auto& record : records) out.cells << wordsText(column.as, memberAt(record, column.at));
    return out;
}

std::vector<ColumnText> columnTexts(const std::vector<ResultColumn>& columns, const json& records) {
    std::vector<ColumnText> all;
    std::map<std::string, std::vector<std::size_t>> alike;  // the member that states the unit: columns in that unit
    for (const auto& column : columns) {
        if ((column.as == As::Number || column.as == As::Spread) && column.unit.starts_with('@'))
            alike[column.unit.substr(1)].push_back(all.size());
        all.push_back(columnText(column, records));
    }
    for (const auto& [unit, inIt] : alike) {
        std::set<json> units;
        for (const auto& record : records) units.insert(memberAt(record, unit));
        if (units.size() < 2) continue;  // the columns have one prefix each
        for (qsizetype row = 0; row < qsizetype(records.size()); ++row) {
            std::vector<QString*> cells;
            for (const auto c : inIt) cells.push_back(&all[c].cells[row]);
            useOneUnit(cells);
        }
    }
    return all;
}

std::vector<ResultTable> tablesIn(const nlohmann::json& results) {
    std::vector<ResultTable> tables;
    std::vector<ResultColumn> single;
    for (const auto& [key, value] : results.items()) {
        if (key == "verdict" || key == "kind" || key == "reasons" || key == "trials") continue;
        const auto title = columnName(QString::fromStdString(key)).title.toStdString();
        const bool records = value.is_array() && !value.empty() &&
                             std::all_of(value.begin(), value.end(), [](const auto& row) { return row.is_object(); });
        const bool texts = value.is_array() && !value.empty() &&
                           std::all_of(value.begin(), value.end(), [](const auto& row) { return row.is_string(); });
        if (isCell(value))
            single.push_back(guessed(key, value));
        else if (records)
            tables.push_back({.title = title, .at = key, .columns = columnsIn(value)});
        else if (texts)
            tables.push_back({.title = title, .at = key, .shape = Shape::Sentences});
    }
    if (!single.empty())
        tables.insert(tables.begin(), {.title = "Found", .shape = Shape::Facts, .columns = std::move(single)});
    return tables;
}

}  // namespace tacto
