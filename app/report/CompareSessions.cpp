#include "app/report/CompareSessions.h"

#include <QStringList>
#include <algorithm>
#include <cmath>
#include <set>

#include "app/report/MatrixBlock.h"
#include "app/report/NumberText.h"
#include "app/report/ResultCells.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/JsonText.h"
#include "core/base/Statistics.h"
#include "core/results/Describe.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

using nlohmann::json;
using As = ResultColumn::As;
using Shape = ResultTable::Shape;

constexpr double kTwoSided = 0.975;

QString textFrom(const std::string& text) { return QString::fromStdString(text); }
QString capital(QString text) { return text.replace(0, 1, text.left(1).toUpper()); }

/// A number of a session with what is known of its uncertainty.
struct Reading {
    double value = kNaN;
    double toLower = kNaN, toUpper = kNaN;  ///< distances to the bounds of its 95 % interval
};

Reading readingOf(const ResultColumn& column, const json& record) {
    const auto minus = column.at.find('-');
    const auto& member = memberAt(record, column.at.substr(0, minus));
    Reading reading{.value = numberOr(member)};
    if (minus != std::string::npos) reading.value -= numberOr(memberAt(record, column.at.substr(minus + 1)));
    if (member.is_object()) {
        reading.value = numberOr(member, member.contains("mean") ? "mean" : "value");
        reading.toLower = reading.value - numberOr(member, "low");
        reading.toUpper = numberOr(member, "high") - reading.value;
    } else if (column.as == As::Number && !column.beside.empty()) {
        reading.toLower = reading.toUpper = numberOr(memberAt(record, column.beside));
    }
    return reading;
}

double expandedOf(const Reading& a, const Reading& b) {
    return b.value >= a.value ? std::hypot(b.toLower, a.toUpper) : std::hypot(b.toUpper, a.toLower);
}

/// The readings of one member in the trials of one condition.
struct Repeated {
    std::vector<double> values, uncertainties;
    double expanded = kNaN;  ///< of the last reading, if it states U
    [[nodiscard]] double n() const { return static_cast<double>(values.size()); }
    [[nodiscard]] double mean() const { return statisticsOf(values).mean; }
    /// Returns the square of the mean's standard deviation, NaN for a single reading.
    [[nodiscard]] double scatter() const {
        const double sd = statisticsOf(values).sd;
        return sd * sd / n();
    }
    /// Returns the mean square of the instrument's standard uncertainty, NaN unless each reading states it.
    [[nodiscard]] double instrument() const {
        double sum = 0;
        for (const double u : uncertainties) sum += u * u;
        return uncertainties.size() == values.size() ? sum / n() : kNaN;
    }
};

double expandedOf(const Repeated& a, const Repeated& b) {
    if (a.values.size() == 1 && b.values.size() == 1) return std::hypot(a.expanded, b.expanded);
    const double typeA[] = {a.scatter(), b.scatter()};
    const double square = typeA[0] + typeA[1] + a.instrument() + b.instrument();
    if (!std::isfinite(square)) return kNaN;
    const double lessened = typeA[0] * typeA[0] / (a.n() - 1) + typeA[1] * typeA[1] / (b.n() - 1);
    const double freedom = lessened > 0 ? square * square / lessened : std::numeric_limits<double>::infinity();
    return studentQuantile(kTwoSided, freedom) * std::sqrt(square);
}

/// Returns the standard uncertainty beside "amplitude_v": "amplitude_v_u" or "amplitude_u_v".
double standardOf(const json& measured, const std::string& key) {
    const double after = numberOr(measured, (key + "_u").c_str());
    if (std::isfinite(after)) return after;
    const auto unit = key.rfind('_');
    return numberOr(measured, (key.substr(0, unit) + "_u" + key.substr(unit)).c_str());
}

const std::vector<ResultColumn>& trialColumns() {
    using describe::number;
    static const std::vector<ResultColumn> all{
        number("Amplitude", "amplitude_v", "V"), number("Current", "amplitude_ma", "mA"),
        number("Interval", "interval_s", "s"), number("Phase width", "width_s", "s"),
        number("Charge per phase", "charge_uc", "uC")};
    return all;
}

bool isNumber(As as) {
    return as == As::Number || as == As::Spread || as == As::Tolerance || as == As::Share || as == As::Jnd ||
           as == As::AtLeast || as == As::Chance;
}

/// Everything that the tables of one session's results hold, by place: table, record, member.
struct Found {
    struct Cell {
        QString name{}, table{};
        std::string unit{};
        Reading reading{};
        json word = nullptr;  ///< a verdict, or yes or no; the cell is then no number
    };
    std::vector<std::pair<QString, Cell>> cells;  ///< in reading order
    std::set<QString> places;
    void add(const QString& place, Cell cell) {
        if (places.insert(place).second) cells.emplace_back(place, std::move(cell));
    }
};

/// Returns what a record is about: the words that it begins with, or its first number: "Rough-high", "Commanded 10 V".
QString subjectOf(const ResultTable& table, const json& record, std::size_t& first) {
    const auto cellOf = [&](const ResultColumn& column) {
        auto text = columnText(column, json::array({record}));
        const auto unit = text.header.section('\n', 1).remove('(').remove(')');
        return isNumber(column.as) ? QString("%1 %2 %3").arg(textFrom(column.title), text.cells[0], unit).trimmed()
                                   : text.cells[0];
    };
    QStringList words;
    for (first = 0; first < table.columns.size(); ++first) {
        const auto& column = table.columns[first];
        if (column.as == As::Verdict || column.as == As::YesNo) continue;
        const bool subject = !isNumber(column.as) && column.as != As::Used && column.as != As::Limit;
        if (!subject && !words.isEmpty()) break;
        words << cellOf(column);
        if (!subject && ++first > 0) break;
    }
    words.removeAll(QStringLiteral("–"));
    return capital(words.join(", "));
}

void takeRecord(const ResultTable& table, const json& record, const QString& subject, std::size_t first, Found& into) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const auto& column = table.columns[c];
        const bool word = column.as == As::Verdict || column.as == As::YesNo;
        if (!word && (c < first || !isNumber(column.as))) continue;
        auto title = textFrom(column.title).section('(', 0, 0).trimmed();
        title = title.section(", mean and s.d.", 0, 0);
        if (column.as == As::Jnd || column.as == As::AtLeast) title += " in JND";
        Found::Cell cell{.name = subject.isEmpty() ? title : subject + ": " + title,
                         .table = textFrom(table.title),
                         .unit = column.unit};
        if (word) {
            cell.word = memberAt(record, column.at);
            if (cell.word.is_null()) continue;
        } else {
            if (column.unit.starts_with('@')) cell.unit = textOr(record, column.unit.substr(1).c_str());
            cell.reading = readingOf(column, record);
            if (column.as == As::Share) {
                cell.unit = "%";
                for (double* part : {&cell.reading.value, &cell.reading.toLower, &cell.reading.toUpper}) *part *= 100;
            }
            if (!std::isfinite(cell.reading.value)) continue;
        }
        into.add(textFrom(table.at) + '/' + subject + '/' + textFrom(column.at), std::move(cell));
    }
}

/// Takes the verdict of each cell of limits against loads; the numbers stand in the tables of loads.
void takeLimits(const ResultTable& table, const json& matrix, Found& into) {
    for (const auto& row : limitsOf(matrix).rows) {
        for (std::size_t c = 0; c < row.cells.size(); ++c) {
            if (row.cells[c].verdict.isEmpty()) continue;
            const auto name = QString("%1, %2").arg(row.title, limitsOf(matrix).columns[qsizetype(c)]);
            into.add(textFrom(table.at) + '/' + name,
                     {.name = name, .table = textFrom(table.title), .word = row.cells[c].verdict.toStdString()});
        }
    }
}

Found foundIn(const json& results) {
    Found all;
    for (const auto& table : tablesOf(results)) {
        const auto& value = table.at.empty() ? results : memberAt(results, table.at);
        if (table.shape == Shape::Limits) takeLimits(table, value, all);
        if (table.shape == Shape::Facts && value.is_object()) takeRecord(table, value, {}, 0, all);
        if (table.shape != Shape::Rows && table.shape != Shape::Across) continue;
        std::map<QString, int> met;
        for (const auto& record : rowsOf(table, results)) {
            std::size_t first = 0;
            auto subject = subjectOf(table, record, first);
            if (const int before = met[subject]++; before > 0) subject += QString(" (%1)").arg(before + 1);
            takeRecord(table, record, subject, first, all);
        }
    }
    return all;
}

/// Returns the first few of a list: "a, b, and 7 more".
QString shortList(const QStringList& all) {
    constexpr qsizetype kNamed = 6;
    if (all.size() <= kNamed + 1) return all.join(", ");
    return QObject::tr("%1, and %2 more").arg(all.first(kNamed).join(", ")).arg(all.size() - kNamed);
}

/// Returns a value as it stands among settings: a word, a number with its unit, or the first few of a list.
json settingOf(const json& value, const QString& unit) {
    if (value.is_array()) {
        QStringList all;
        for (const auto& each : value) {
            const auto text = settingOf(each, unit);
            all << (text.is_string() ? textFrom(text.get<std::string>()) : textFrom(dumpJson(text)));
        }
        return shortList(all).toStdString();
    }
    if (value.is_number() && !unit.isEmpty()) return settingText(value.get<double>(), unit).toStdString();
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    return value;
}

class Comparing {
public:
    Comparing(const ComparedSession& a, const ComparedSession& b) : a_(a), b_(b) {}

    SessionComparison run() {
        setting("Procedure", a_.about.protocol, b_.about.protocol);
        setting("Mode", a_.about.mode, b_.about.mode);
        const auto verdict = [](const ComparedSession& s) {
            return s.verdicts.empty() ? "" : s.verdicts.back().verdict;
        };
        setting("Verdict", verdict(a_), verdict(b_));
        setting("Ended in order", a_.closed, b_.closed);
        setting("Operator", a_.labels.operatorName, b_.labels.operatorName);
        setting("Sample", a_.labels.sample, b_.labels.sample);
        devices();
        parameters();
        profile();
        const auto limits = [](const ComparedSession& s) {
            QStringList all;
            for (const auto& set : s.about.limitSets)
                all << limitSetTitle(textFrom(set.id)) + ' ' + set.sha256.substr(0, 8).c_str();
            return all.join(", ").toStdString();
        };
        setting("Limits", limits(a_), limits(b_));
        setting("Program", a_.about.programVersion, b_.about.programVersion);
        setting("Seed", a_.about.seed, b_.about.seed);
        totals();
        trials();
        results();
        sortBySignificance(all_.quantities);
        return std::move(all_);
    }

private:
    void setting(const QString& name, const json& a, const json& b, const QString& unit = {}) {
        if (a == b) return;
        const auto shown = [&](const json& value) {
            const bool none = value.is_string() && value.get_ref<const std::string&>().empty();
            return none ? json() : settingOf(value, unit);
        };
        all_.settings.push_back({name.toStdString(), shown(a), shown(b)});
    }

    void quantity(const QString& name, const std::string& unit, double a, double b, double expanded) {
        if (!std::isfinite(a) || !std::isfinite(b)) return;
        if (!std::isfinite(expanded)) expanded = kNaN;
        if (a == b && std::isnan(expanded)) return;
        all_.quantities.push_back({name.toStdString(), unit, a, b, expanded});
    }

    void devices() {
        std::set<std::string> alike;  // a name that both have is left out: the addresses differ
        for (const auto& device : a_.about.devices)
            if (std::ranges::find(b_.about.devices, device.name, &SessionDevice::name) != b_.about.devices.end())
                alike.insert(device.name);
        const auto named = [&alike](const ComparedSession& session) {
            std::map<std::string, std::string> all;
            for (const auto& device : session.about.devices) {
                auto& text = all[device.role];
                if (!text.empty()) text += ", ";
                if (!alike.contains(device.name)) text += device.name + ", ";
                text += device.uri + (device.serial.empty() ? "" : ", serial " + device.serial);
            }
            return all;
        };
        auto a = named(a_), b = named(b_);
        for (const auto& [role, name] : a) b.try_emplace(role);
        for (const auto& [role, name] : b) setting(columnName(textFrom(role)).title, a[role], name);
    }

    struct Leaf {
        QString name, unit;
        json value;
    };
    /// Collects every plain value below `at`, and each list of plain values, by place.
    static void leavesOf(const json& at, const std::string& place, const QString& name,
                         std::map<std::string, Leaf>& into) {
        int index = 0;
        for (const auto& [key, value] : at.items()) {
            const auto column = columnName(textFrom(key));
            const auto own = at.is_array() ? textOr(value, "name") : std::string();
            const auto part = !own.empty() ? textFrom(own) : at.is_array() ? QString::number(index + 1) : column.title;
            ++index;
            const auto named = name + ", " + part.left(1).toLower() + part.mid(1);
            const auto where = place + '/' + key;
            const bool plainList = value.is_array() && std::ranges::none_of(value, &json::is_structured);
            if (value.is_structured() && !plainList)
                leavesOf(value, where, named, into);
            else
                into[where] = {named, column.unit, value};
        }
    }

    void compareLeaves(const QString& name, const json& a, const json& b) {
        std::map<std::string, Leaf> first, second;
        leavesOf(a, "", name, first);
        leavesOf(b, "", name, second);
        for (const auto& [place, leaf] : first) second.try_emplace(place, Leaf{leaf.name, leaf.unit, nullptr});
        for (const auto& [place, leaf] : second) {
            const auto before = first.find(place);
            setting(leaf.name, before == first.end() ? json() : before->second.value, leaf.value, leaf.unit);
        }
    }

    void parameters() {
        const auto &a = a_.about.parameters, &b = b_.about.parameters;
        auto keys = b;
        for (const auto& [key, value] : a.items()) keys[key] = value;
        for (const auto& [key, value] : keys.items()) {
            const auto first = valueOr(a, key.c_str()), second = valueOr(b, key.c_str());
            // Another procedure has other settings.
            if ((first.is_null() || second.is_null()) && a_.about.protocol != b_.about.protocol) continue;
            const auto declared = b_.settings.find(key);
            const bool known = declared != b_.settings.end();
            const auto column = columnName(textFrom(key));
            const auto label = known ? textFrom(textOr(declared->second, "label")) : column.title;
            const auto unit = known ? textFrom(textOr(declared->second, "unit")) : column.unit;
            if (first.is_object() || second.is_object())
                compareLeaves(label, first, second);
            else
                setting(label, first, second, unit);
        }
    }

    void profile() {
        const auto a = parseJson(a_.about.profileJson, "the profile"),
                   b = parseJson(b_.about.profileJson, "the profile");
        if (a && b) compareLeaves("Profile", *a, *b);
    }

    void totals() {
        quantity("Duration", "s", toSeconds(a_.length), toSeconds(b_.length), kNaN);
        const auto &a = a_.delivered, &b = b_.delivered;
        quantity("Trains delivered", "", static_cast<double>(a.trains), static_cast<double>(b.trains), kNaN);
        if (a.unit == b.unit && a.trains > 0 && b.trains > 0)
            quantity("Largest amplitude commanded", a.unit, a.most, b.most, kNaN);
    }

    using Conditions = std::map<std::string, std::vector<Repeated>>;
    static Conditions conditionsOf(const ComparedSession& session) {
        Conditions all;
        const auto& columns = trialColumns();
        for (const auto& trial : session.trials) {
            if (trial.sealed) continue;
            auto& repeated = all[trial.condition];
            repeated.resize(columns.size());
            for (std::size_t c = 0; c < columns.size(); ++c) {
                const double value = numberOr(trial.measured, columns[c].at.c_str());
                if (!std::isfinite(value)) continue;
                repeated[c].values.push_back(value);
                double u = standardOf(trial.measured, columns[c].at);
                // That of an interval is stated without the time base; a time base that is not known makes U unknown.
                if (columns[c].at == "interval_s" && trial.measured.contains("time_base_u"))
                    u = std::hypot(u, numberOr(trial.measured, "time_base_u") * value);
                if (std::isfinite(u)) repeated[c].uncertainties.push_back(u);
                repeated[c].expanded = numberOr(trial.measured, (columns[c].at + "_expanded").c_str());
            }
        }
        return all;
    }

    void trials() {
        const auto a = conditionsOf(a_), b = conditionsOf(b_);
        QStringList alone[2];
        const auto nameOf = [](const std::string& condition) {
            auto name = loadText(textFrom(condition));
            return name.isEmpty() ? QStringLiteral("Trials") : capital(name);
        };
        for (const auto& [condition, repeated] : b) {
            const auto before = a.find(condition);
            if (before == a.end()) {
                alone[1] << nameOf(condition);
                continue;
            }
            for (std::size_t c = 0; c < trialColumns().size(); ++c) {
                const auto &first = before->second[c], &second = repeated[c];
                if (first.values.empty() || second.values.empty()) continue;
                const auto name = nameOf(condition) + ": " + textFrom(trialColumns()[c].title);
                names_.insert(name.toLower());
                quantity(name, trialColumns()[c].unit, first.mean(), second.mean(), expandedOf(first, second));
            }
        }
        for (const auto& [condition, repeated] : a)
            if (!b.contains(condition)) alone[0] << nameOf(condition);
        setting("Conditions that only one has", shortList(alone[0]).toStdString(), shortList(alone[1]).toStdString());
    }

    void results() {
        if (a_.verdicts.empty() || b_.verdicts.empty()) return;
        const auto &a = a_.verdicts.back().results, &b = b_.verdicts.back().results;
        if (!a.is_object() || !b.is_object() || valueOr(a, "kind") != valueOr(b, "kind")) return;
        const auto first = foundIn(a);
        const std::map<QString, Found::Cell> before(first.cells.begin(), first.cells.end());
        for (auto& [place, cell] : foundIn(b).cells) {
            const auto other = before.find(place);
            if (other == before.end() || other->second.unit != cell.unit) continue;
            const auto& was = other->second;
            if (cell.name.contains(": ") && names_.contains(cell.name.toLower()) && cell.word.is_null()) continue;
            const bool taken = !resultNames_.insert(cell.name).second;
            const auto name = taken ? cell.table + ": " + cell.name : cell.name;
            if (!cell.word.is_null())
                setting(name, was.word, cell.word);
            else
                quantity(name, cell.unit, was.reading.value, cell.reading.value, expandedOf(was.reading, cell.reading));
        }
    }

    const ComparedSession& a_;
    const ComparedSession& b_;
    SessionComparison all_;
    std::set<QString> names_;  ///< of the means of trials, which state a better U than a result's own means
    std::set<QString> resultNames_;
};

}  // namespace

Result<ComparedSession> readForComparison(const SessionReader& reader,
                                          const std::function<void(const SessionRow&)>& alsoTrain) {
    ComparedSession session;
    session.about = reader.about();
    session.closed = reader.closed();
    session.length = reader.lastAt();
    const auto take = [](auto&& from, auto& into) -> Result<void> {
        if (!from) return failure(from);
        into = std::move(*from);
        return {};
    };
    std::vector<SessionRow> items;
    if (auto done = take(reader.labels(), session.labels); !done) return failure(done);
    if (auto done = take(reader.verdicts(), session.verdicts); !done) return failure(done);
    if (auto done = take(reader.trials(), session.trials); !done) return failure(done);
    if (auto done = take(reader.reportItems(), items); !done) return failure(done);
    if (auto done = take(deliveredIn(reader, alsoTrain), session.delivered); !done) return failure(done);
    for (const auto& item : items) {
        if (textOr(item.body, "kind") != "about") continue;
        for (const auto& parameter : valueOr(item.body, "parameters"))
            session.settings[textOr(parameter, "name")] = parameter;
    }
    return session;
}

SessionComparison compareTwo(const ComparedSession& a, const ComparedSession& b) { return Comparing(a, b).run(); }

}  // namespace tacto
