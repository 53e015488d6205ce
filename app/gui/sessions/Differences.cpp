#include "app/gui/sessions/Differences.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kMaxNamedAlone = 4;  // up to this many, conditions are named one by one
constexpr int kMaxPerPart = 120;   // most sentences per part; more would not be read

QString tr(const char* text) { return QObject::tr(text); }

/// Returns both numbers with as many digits as needed to tell them apart, at least four.
std::pair<QString, QString> apart(double first, double second, const QString& unit) {
    for (int digits = 4; digits < 8; ++digits) {
        const std::pair both{quantityText(first, unit, digits), quantityText(second, unit, digits)};
        if (both.first != both.second) return both;
    }
    return {};
}

class Comparison {
public:
    Comparison(const ReadSession& first, const ReadSession& second) : first_(first), second_(second) {}

    QList<Difference> run() {
        endings();
        delivered();
        conditions();
        results();
        const auto found = int(all_.size());
        about_ = Difference::About::Used;
        labels();
        devices();
        settings();
        profile();
        texts(tr("The program was %1 in the second where it was %2 in the first."), qtext(first_.about.programVersion),
              qtext(second_.about.programVersion));
        if (first_.about.seed != second_.about.seed)
            add(tr("The seed was %1 in the second where it was %2 in the first.")
                    .arg(second_.about.seed)
                    .arg(first_.about.seed));
        keep(found);
        return std::move(all_);
    }

private:
    void add(const QString& sentence) { all_ << Difference{about_, sentence}; }

    /// Shortens each part to as many sentences as people read.
    void keep(int found) {
        const auto shorten = [&](int from, int to) {
            const int left = to - from - kMaxPerPart;
            if (left <= 0) return;
            const auto about = all_[from].about;
            all_.remove(from + kMaxPerPart, left);
            all_.insert(from + kMaxPerPart, {about, QObject::tr("%1 more differ.").arg(left)});
        };
        shorten(found, int(all_.size()));
        shorten(0, found);
    }

    /// `sentence` takes the second session's text, then the first's.
    void texts(const QString& sentence, const QString& first, const QString& second) {
        const auto shown = [](const QString& text) { return text.isEmpty() ? tr("not recorded") : text; };
        if (first != second) add(sentence.arg(shown(second), shown(first)));
    }

    void numbers(const QString& sentence, double first, double second, const QString& unit) {
        if (first == second || (std::isnan(first) && std::isnan(second))) return;
        const auto both = apart(first, second, unit);
        if (!both.first.isEmpty()) add(sentence.arg(both.second, both.first));
    }

    void endings() {
        texts(tr("The second is %1 where the first is %2."), procedureText(first_.about.protocol),
              procedureText(second_.about.protocol));
        const auto verdict = [](const ReadSession& session) {
            return session.verdicts.empty() ? tr("no verdict") : qtext(session.verdicts.back().verdict);
        };
        texts(tr("The second ended with %1 where the first ended with %2."), verdict(first_), verdict(second_));
        if (first_.closed != second_.closed)
            add(first_.closed ? tr("The second was not ended in order, as the first was.")
                              : tr("The second was ended in order, which the first was not."));
        if (std::abs(toSeconds(first_.length - second_.length)) >= 1)
            texts(tr("The second lasted %1 where the first lasted %2."), durationText(toSeconds(first_.length)),
                  durationText(toSeconds(second_.length)));
    }

    void delivered() {
        if (first_.trains != second_.trains)
            add(tr("The second delivered %1 trains where the first delivered %2.")
                    .arg(second_.trains)
                    .arg(first_.trains));
        if (first_.unit == second_.unit && first_.trains > 0 && second_.trains > 0)
            numbers(tr("The second delivered at most %1 where the first delivered at most %2."), first_.most,
                    second_.most, first_.unit);
    }

    struct Means {
        std::map<std::string, std::pair<double, int>> sums;  ///< by quantity
        int trials = 0;
    };
    static std::map<std::string, Means> meansOf(const ReadSession& session) {
        std::map<std::string, Means> all;
        for (const auto& trial : session.trials) {
            auto& means = all[trial.condition];
            ++means.trials;
            for (const char* key : {"amplitude_v", "interval_s", "width_s", "charge_uc"}) {
                const double value = numberOr(trial.measured, key);
                if (!std::isfinite(value)) continue;
                means.sums[key].first += value;
                ++means.sums[key].second;
            }
        }
        return all;
    }

    void conditions() {
        const auto first = meansOf(first_), second = meansOf(second_);
        const std::pair<const char*, std::pair<QString, QString>> said[] = {
            {"amplitude_v", {tr("%1: the second delivered %2 where the first delivered %3%4."), "V"}},
            {"interval_s", {tr("%1: trains came every %2 in the second and every %3 in the first%4."), "s"}},
            {"width_s", {tr("%1: phases lasted %2 in the second and %3 in the first%4."), "s"}},
            {"charge_uc", {tr("%1: a phase had %2 in the second and %3 in the first%4."), "µC"}}};
        for (const auto& [condition, means] : second) {
            const auto name = condition.empty() ? tr("Without a condition") : titled(conditionText(condition));
            const auto before = first.find(condition);
            if (before == first.end()) continue;
            for (const auto& [key, words] : said) {
                const auto a = before->second.sums.find(key), b = means.sums.find(key);
                if (a == before->second.sums.end() || b == means.sums.end()) continue;
                const auto count =
                    QObject::tr(" (means of %1 and %2 trials)").arg(b->second.second).arg(a->second.second);
                const auto both =
                    apart(a->second.first / a->second.second, b->second.first / b->second.second, words.second);
                if (!both.first.isEmpty()) add(words.first.arg(name, both.second, both.first, count));
            }
        }
        alone(second, first, tr("%1: %2 in the second, none in the first."),
              tr("%1 conditions of the second are not in the first."));
        alone(first, second, tr("%1: %2 in the first, none in the second."),
              tr("%1 conditions of the first are not in the second."));
    }

    /// Adds conditions that only one session has: by name if they are few.
    void alone(const std::map<std::string, Means>& of, const std::map<std::string, Means>& other, const QString& each,
               const QString& together) {
        QStringList sentences;
        for (const auto& [condition, means] : of)
            if (!other.contains(condition))
                sentences << each.arg(titled(conditionText(condition)), trialsText(std::size_t(means.trials)));
        if (sentences.size() > kMaxNamedAlone) return add(together.arg(sentences.size()));
        for (const auto& sentence : sentences) add(sentence);
    }

    struct Leaf {
        QString name;
        QString unit;
        nlohmann::json value;
    };
    /// Collects every plain value below `at` by place, with its name in tables; leaves out lists of numbers.
    static void leavesOf(const nlohmann::json& at, const std::string& place, const QString& name,
                         std::map<std::string, Leaf>& into) {
        int index = 0;
        for (const auto& [key, value] : at.items()) {
            if (key == "trials" || key == "people") continue;  // single trials and people are not compared
            if (at.is_array() && !value.is_object()) continue;
            const auto column = columnName(qtext(key));
            const auto own = at.is_array() ? textOr(value, "name") : std::string();
            const auto part = !own.empty()    ? qtext(own)
                              : at.is_array() ? QString::number(index + 1)
                                              : column.title.toLower();
            const auto named = name.isEmpty() ? part : name + ", " + part;
            ++index;
            auto where = place;
            where.append("/").append(key);
            if (value.is_structured())
                leavesOf(value, where, named, into);
            else
                into[where] = {named, column.unit, value};
        }
    }

    static QString leafText(const nlohmann::json& value) {
        if (value.is_string()) return qtext(value.get<std::string>());
        if (value.is_boolean()) return value.get<bool>() ? tr("yes") : tr("no");
        return value.is_null() ? tr("not known") : qtext(dumpJson(value));
    }

    void leaves(const nlohmann::json& first, const nlohmann::json& second, const QString& prefix) {
        std::map<std::string, Leaf> a, b;
        leavesOf(first, "", prefix, a);
        leavesOf(second, "", prefix, b);
        for (const auto& [place, leaf] : b) {
            const auto before = a.find(place);
            if (before == a.end() || before->second.value == leaf.value) continue;
            const auto sentence = titled(leaf.name) + tr(": %1 in the second where the first has %2.");
            if (leaf.value.is_number() && before->second.value.is_number())
                numbers(sentence, before->second.value.get<double>(), leaf.value.get<double>(), leaf.unit);
            else
                texts(sentence, leafText(before->second.value), leafText(leaf.value));
        }
    }

    void results() {
        if (first_.verdicts.empty() || second_.verdicts.empty()) return;
        leaves(first_.verdicts.back().results, second_.verdicts.back().results, {});
    }

    void labels() {
        const auto &a = first_.labels, &b = second_.labels;
        texts(tr("The second was done by %1, the first by %2."), qtext(a.operatorName), qtext(b.operatorName));
        texts(tr("The second is of sample %1, the first of sample %2."), qtext(a.sample), qtext(b.sample));
    }

    void devices() {
        const auto named = [](const ReadSession& session) {
            std::map<std::string, QString> all;
            for (const auto& device : session.about.devices)
                all[device.role] =
                    QString("%1 (%2%3)")
                        .arg(qtext(device.name), qtext(device.uri),
                             device.serial.empty() ? QString() : QObject::tr(", serial %1").arg(qtext(device.serial)));
            return all;
        };
        auto first = named(first_), second = named(second_);
        for (const auto& [role, name] : first) second.try_emplace(role);
        for (const auto& [role, name] : second)
            texts(titled(qtext(role)) + tr(": %1 in the second, %2 in the first."), first[role], name);
    }

    void settings() {
        const auto &a = first_.about.parameters, &b = second_.about.parameters;
        for (const auto& [key, value] : b.items()) {
            const auto before = valueOr(a, key.c_str());
            if (before.is_null() || before == value) continue;
            const auto declared = second_.settings.find(key);
            const bool known = declared != second_.settings.end();
            const auto column = columnName(qtext(key));
            const auto label = known ? qtext(textOr(declared->second, "label")) : column.title;
            const auto unit = known ? qtext(textOr(declared->second, "unit")) : column.unit;
            const auto sentence = tr("Setting “%1”").arg(label) + tr(": %1 in the second, %2 in the first.");
            if (value.is_number() && before.is_number())
                numbers(sentence, before.get<double>(), value.get<double>(), unit);
            else
                texts(sentence, leafText(before), leafText(value));
        }
    }

    void profile() {
        const auto a = parseJson(first_.about.profileJson, "the profile"),
                   b = parseJson(second_.about.profileJson, "the profile");
        if (a && b) leaves(*a, *b, tr("encoding profile"));
    }

    const ReadSession& first_;
    const ReadSession& second_;
    Difference::About about_ = Difference::About::Found;
    QList<Difference> all_;
};

}  // namespace

QList<Difference> differencesOf(const ReadSession& first, const ReadSession& second) {
    return Comparison(first, second).run();
}

}  // namespace tacto::gui
