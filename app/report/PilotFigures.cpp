#include "app/report/PilotFigures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/StudyText.h"
#include "core/analysis/identification/EncodingsOverPeople.h"
#include "core/analysis/identification/OverSessions.h"
#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

using Curve = CurvesFigure::Curve;
using Axis = CurvesFigure::Axis;

constexpr double kPercent = 100;
constexpr const char* kRight = "Right answers";

/// Adds a value with its interval to a curve.
void add(Curve& curve, double x, const Estimate& y, double scale = 1) {
    curve.x.push_back(x);
    curve.y.push_back(scale * y.value);
    curve.low.push_back(scale * y.low);
    curve.high.push_back(scale * y.high);
}

Curve curveNamed(const QString& label, bool points = false) {
    Curve curve;
    curve.label = label;
    curve.points = points;
    return curve;
}

Axis levelAxis(const QString& what, bool massager) { return {what, massager ? "strength" : "mA", {}}; }

QStringList numbersTo(std::size_t last) {
    QStringList all;
    for (std::size_t i = 1; i <= last; ++i) all << QString::number(i);
    return all;
}

QString intervalText(const Estimate& estimate, int decimals) {
    return std::isfinite(estimate.low)
               ? QString("%1 (%2 to %3)")
                     .arg(figureText(estimate.value, decimals), figureText(estimate.low, decimals),
                          figureText(estimate.high, decimals))
               : figureText(estimate.value, decimals);
}

QString sessionName(const BidsSession& session) {
    return session.encoding.empty() ? QString("session %1").arg(session.number)
                                    : QString("session %1, %2").arg(session.number).arg(qtext(session.encoding));
}

/// Quantile of sorted values, by linear interpolation between them.
double quantileOf(const std::vector<double>& sorted, double q) {
    if (sorted.empty()) return kNaN;
    const double place = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The detection trials of a session's last measurement: levels and whether the answer was right.
std::vector<LevelAnswer> detectionOf(const BidsSession& session, bool massager) {
    std::vector<LevelAnswer> all;
    for (const auto& trial : session.thresholds) {
        const double level = massager ? trial.intensity : trial.current.value();
        if (trial.measurement != session.measurements) continue;
        if (trial.procedure == "detection" && trial.correct && level > 0) all.push_back({level, *trial.correct});
    }
    return all;
}

/// 41 levels from a little below the least to a little above the largest, in equal ratios.
std::vector<double> levelsAround(const std::vector<LevelAnswer>& answers) {
    const auto [least, most] = std::ranges::minmax_element(answers, {}, &LevelAnswer::level);
    const double from = 0.8 * least->level, to = 1.1 * most->level;
    constexpr int kSteps = 40;
    std::vector<double> all;
    for (int i = 0; i <= kSteps; ++i) all.push_back(from * std::pow(to / from, double(i) / kSteps));
    return all;
}

struct FoundDetection {
    std::vector<LevelAnswer> answers;
    std::vector<double> levels;
    DetectionCourse course;
};

/// Nothing if the session has no detection trial, or nothing was felt before it.
Result<std::optional<FoundDetection>> detectionIn(const BidsSession& session, bool massager) {
    FoundDetection found;
    found.answers = detectionOf(session, massager);
    if (found.answers.empty() || !(session.felt > 0)) return std::optional<FoundDetection>();
    found.levels = levelsAround(found.answers);
    auto course = detectionCourse(found.answers, session.felt, found.levels);
    if (!course) return failure(course);
    found.course = std::move(*course);
    return std::optional(std::move(found));
}

CurvesFigure functionFigure(const FoundDetection& found, bool massager) {
    CurvesFigure figure;
    figure.x = levelAxis("Level", massager);
    figure.y = {kRight, "%", {}};
    auto fitted = curveNamed("model, with its 95 % interval");
    for (std::size_t i = 0; i < found.levels.size(); ++i) add(fitted, found.levels[i], found.course.right[i], kPercent);
    std::map<double, std::pair<std::size_t, std::size_t>> levels;  // trials, right
    for (const auto& answer : found.answers) {
        auto& [n, right] = levels[answer.level];
        ++n;
        right += answer.correct ? 1 : 0;
    }
    auto trials = curveNamed("trials, with Wilson’s 95 % interval", true);
    for (const auto& [level, counts] : levels) {
        add(trials, level, wilsonInterval(counts.second, counts.first), kPercent);
        trials.n.push_back(static_cast<double>(counts.first));
    }
    figure.curves = {std::move(fitted), std::move(trials)};
    figure.lines = {{"threshold: 80 % right", 80}, {"guessing", 50}};
    return figure;
}

CurvesFigure traceFigure(const FoundDetection& found, bool massager) {
    CurvesFigure figure;
    figure.x = {"Trial", "", {}};
    figure.y = levelAxis("Level", massager);
    auto estimate = curveNamed("estimate, with its 95 % interval");
    auto right = curveNamed("right", true), wrong = curveNamed("wrong", true);
    wrong.open = true;
    for (std::size_t i = 0; i < found.answers.size(); ++i) {
        const double trial = static_cast<double>(i + 1);
        add(estimate, trial, found.course.threshold[i]);
        auto& of = found.answers[i].correct ? right : wrong;
        of.x.push_back(trial);
        of.y.push_back(found.answers[i].level);
    }
    figure.curves = {std::move(estimate), std::move(right), std::move(wrong)};
    return figure;
}

/// Names every session with its day.
QStringList sessionNames(const StudyPerson& person) {
    QStringList names;
    for (const auto& one : person.sessions()) {
        const auto& session = one.session->results;
        names << (std::isfinite(session.days) ? QString("%1 (day %2)").arg(session.number).arg(session.days)
                                              : QString::number(session.number));
    }
    return names;
}

Axis sessionAxis(const StudyPerson& person) { return {"Session", "", sessionNames(person)}; }

CurvesFigure learningFigure(const StudyPerson& person, QString& note) {
    CurvesFigure figure;
    std::size_t last = 0;
    for (const auto& one : person.sessions()) {
        if (one.found.all.n == 0) continue;
        auto curve = curveNamed(sessionName(one.session->results));
        for (const auto& block : one.found.blocks) {
            add(curve, static_cast<double>(block.block), wilsonInterval(block.hits, block.n), kPercent);
            last = std::max(last, block.block);
        }
        figure.curves.push_back(std::move(curve));
        if (std::isfinite(one.found.learning.value))
            note += QString(" Session %1: %2 in log odds per block.")
                        .arg(one.session->results.number)
                        .arg(intervalText(one.found.learning, 2));
    }
    figure.x = {"Block of the test", "", numbersTo(last)};
    figure.y = {kRight, "%", {}};
    return figure;
}

CurvesFigure thresholdsFigure(const StudyPerson& person, bool massager) {
    CurvesFigure figure;
    figure.x = sessionAxis(person);
    figure.y = levelAxis("Level", massager);
    auto detection = curveNamed("detection, with its 95 % interval", true), strong = curveNamed("too strong"),
         high = curveNamed("highest of the range"), low = curveNamed("lowest of the range");
    double x = 0;
    for (const auto& one : person.sessions()) {
        const auto& session = one.session->results;
        x += 1;
        if (std::isfinite(session.detection))
            add(detection, x, {session.detection, session.detectionLow, session.detectionHigh});
        const auto point = [x](Curve& curve, double level) {
            if (!std::isfinite(level)) return;
            curve.x.push_back(x);
            curve.y.push_back(level);
        };
        if (session.saidTooStrong) point(strong, session.tooStrong);
        if (!hasUsableRange(session)) continue;
        point(high, massager ? session.highIntensity : session.high.value());
        point(low, massager ? session.lowIntensity : session.low.value());
    }
    for (auto* curve : {&detection, &strong, &high, &low}) {
        if (!curve->x.empty()) figure.curves.push_back(std::move(*curve));
    }
    return figure;
}

/// The detection threshold before the first block and at each drift check; only sessions that have one.
CurvesFigure driftFigure(const StudyPerson& person, bool massager) {
    CurvesFigure figure;
    std::size_t last = 1;
    for (const auto& one : person.sessions()) {
        const auto& session = one.session->results;
        if (session.drift.empty()) continue;
        auto curve = curveNamed(sessionName(session));
        if (std::isfinite(session.detection))
            add(curve, 1, {session.detection, session.detectionLow, session.detectionHigh});
        for (const auto& check : session.drift) {
            if (!std::isfinite(check.detection)) continue;
            add(curve, static_cast<double>(check.block), {check.detection, check.low, check.high});
            last = std::max(last, check.block);
        }
        if (!curve.x.empty()) figure.curves.push_back(std::move(curve));
    }
    figure.x = {"Before block", "", numbersTo(last)};
    figure.y = levelAxis("Detection threshold", massager);
    return figure;
}

CurvesFigure accuracyFigure(const StudyPerson& person) {
    CurvesFigure figure;
    figure.x = sessionAxis(person);
    figure.y = {kRight, "%", {}};
    double x = 0;
    for (const auto& one : person.sessions()) {
        x += 1;
        if (one.found.all.n == 0) continue;
        const auto name =
            one.session->results.encoding.empty() ? QString("answers") : qtext(one.session->results.encoding);
        auto curve = std::ranges::find(figure.curves, name, &Curve::label);
        if (curve == figure.curves.end()) curve = figure.curves.insert(curve, curveNamed(name, true));
        add(*curve, x, one.found.all.accuracy, kPercent);
        curve->n.push_back(static_cast<double>(one.found.all.n));
    }
    return figure;
}

/// The share of answers that were given by a time, for each condition; all sessions.
CurvesFigure responseFigure(const StudyPerson& person) {
    CurvesFigure figure;
    figure.x = {"Response time", "s", {}};
    figure.y = {"Answered", "%", {}};
    std::vector<std::string> labels;
    for (const auto& one : person.sessions()) {
        for (const auto& label : one.found.labels) {
            if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
        }
    }
    for (const auto& label : labels) {
        std::vector<double> times;
        for (const auto& one : person.sessions())
            std::ranges::copy(responseTimes(one.session->results, label), std::back_inserter(times));
        if (times.empty()) continue;
        std::ranges::sort(times);
        auto curve = curveNamed(qtext(label));
        curve.steps = true;
        for (std::size_t i = 0; i < times.size(); ++i) {
            curve.x.push_back(times[i]);
            curve.y.push_back(kPercent * static_cast<double>(i + 1) / static_cast<double>(times.size()));
        }
        figure.curves.push_back(std::move(curve));
    }
    return figure;
}

/// Median response time of each session, with the quartiles.
CurvesFigure responsesOverSessions(const StudyPerson& person) {
    CurvesFigure figure;
    figure.x = sessionAxis(person);
    figure.y = {"Response time", "s", {}};
    auto curve = curveNamed("median, with the quartiles", true);
    double x = 0;
    for (const auto& one : person.sessions()) {
        x += 1;
        const auto times = responseTimes(one.session->results);
        if (!times.empty()) add(curve, x, {quantileOf(times, 0.5), quantileOf(times, 0.25), quantileOf(times, 0.75)});
    }
    if (!curve.x.empty()) figure.curves.push_back(std::move(curve));
    return figure;
}

double chanceOf(const StudyPerson& person) {
    for (const auto& one : person.sessions()) {
        if (one.found.all.n > 0) return one.found.all.chance;
    }
    return kNaN;
}

void addChance(CurvesFigure& figure, double chance) {
    if (std::isfinite(chance)) figure.lines.push_back({"guessing", kPercent * chance});
}

/// One value of a person at a place, with its variance by its trials.
struct PersonValue {
    double value = kNaN;
    double variance = 0;
};
using PersonCourse = std::map<std::size_t, PersonValue>;

double varianceOfShare(std::size_t hits, std::size_t n) {
    const double all = static_cast<double>(n) + 4, p = (static_cast<double>(hits) + 2) / all;
    return p * (1 - p) / all;
}

enum class Scale { Plain, Share, LogRatio };  ///< shares are shown in %, and logarithms of ratios as ratios

/// A curve for each person and their mean with its interval, where at least two have a value.
CurvesFigure overPeople(const std::vector<std::pair<QString, PersonCourse>>& people, Scale scale) {
    CurvesFigure figure;
    std::size_t last = 0;
    std::map<std::size_t, std::pair<std::vector<double>, std::vector<double>>> places;
    const auto shown = [scale](double value) {
        // A share has its ends at 0 and 1, also where the interval of a mean reaches beyond.
        return scale == Scale::Share      ? kPercent * std::clamp(value, 0.0, 1.0)
               : scale == Scale::LogRatio ? std::exp(value)
                                          : value;
    };
    for (const auto& [name, course] : people) {
        auto curve = curveNamed(name);
        for (const auto& [place, one] : course) {
            if (!std::isfinite(one.value)) continue;
            curve.x.push_back(static_cast<double>(place));
            curve.y.push_back(shown(one.value));
            last = std::max(last, place);
            places[place].first.push_back(one.value);
            places[place].second.push_back(one.variance);
        }
        if (!curve.x.empty()) figure.curves.push_back(std::move(curve));
    }
    auto mean = curveNamed("mean over people, with its 95 % interval", true);
    for (const auto& [place, values] : places) {
        if (values.first.size() < 2) continue;
        const auto found = meanOverPeople(values.first, values.second);
        add(mean, static_cast<double>(place) + 0.08, {shown(found.value), shown(found.low), shown(found.high)});
    }
    if (!mean.x.empty()) figure.curves.push_back(std::move(mean));
    figure.x.names = numbersTo(last);
    return figure;
}

PersonCourse accuracyOverBlocks(const StudyPerson& person) {
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> blocks;  // right, trials; all sessions
    for (const auto& one : person.sessions()) {
        for (const auto& block : one.found.blocks) {
            blocks[block.block].first += block.hits;
            blocks[block.block].second += block.n;
        }
    }
    PersonCourse course;
    for (const auto& [block, counts] : blocks) {
        const auto& [hits, n] = counts;
        if (n > 0) course[block] = {static_cast<double>(hits) / static_cast<double>(n), varianceOfShare(hits, n)};
    }
    return course;
}

/// `valueOf`: from the session and its place among those of the person, from 1.
template <class ValueOf>
PersonCourse overSessions(const StudyPerson& person, ValueOf valueOf) {
    PersonCourse course;
    std::size_t place = 0;
    for (const auto& one : person.sessions()) course[++place] = valueOf(one);
    return course;
}

PersonValue accuracyIn(const AnalysedSession& one) {
    const auto& all = one.found.all;
    return all.n == 0 ? PersonValue() : PersonValue{all.accuracy.value, varianceOfShare(all.hits, all.n)};
}

/// Logarithm of the detection threshold against the first session that has one.
PersonCourse detectionRatios(const StudyPerson& person) {
    const Estimate* first = nullptr;
    std::vector<Estimate> kept;
    kept.reserve(person.sessions().size());
    return overSessions(person, [&](const AnalysedSession& one) -> PersonValue {
        const auto& session = one.session->results;
        kept.push_back({session.detection, session.detectionLow, session.detectionHigh});
        const auto& now = kept.back();
        if (!(now.value > 0)) return {};
        if (first == nullptr) {
            first = &now;
            return {0, 0};
        }
        static const double kWidth = 2 * studentQuantile(0.975, std::numeric_limits<double>::infinity());
        const auto ratio = ratioOf(now, *first);
        const double sd = std::log(ratio.high / ratio.low) / kWidth;
        return {std::log(ratio.value), std::isfinite(sd) ? sd * sd : 0};
    });
}

class Figures {
public:
    Figures(std::string name, QString who, bool simulated)
        : name_(std::move(name)), who_(std::move(who)), simulated_(simulated) {}

    /// Leaves out a figure without a curve.
    void add(const char* name, const QString& caption, CurvesFigure figure, const QString& note = {}) {
        if (figure.curves.empty()) return;
        all_.push_back(
            {fmt::format("{}-{}", name_, name), who_ + caption, {std::move(figure), note.trimmed()}, simulated_});
    }
    /// Leaves out a figure with fewer than two sessions.
    void addCourse(const char* name, const QString& caption, CurvesFigure figure, const QString& note = {}) {
        if (figure.x.names.size() > 1) add(name, caption, std::move(figure), note);
    }
    [[nodiscard]] std::vector<PilotFigure> take() { return std::move(all_); }

private:
    std::string name_;
    QString who_;
    bool simulated_;
    std::vector<PilotFigure> all_;
};

constexpr const char* kMeanNote =
    "The mean takes people’s values to be normally distributed (t); it is never narrower than the trials allow.";

}  // namespace

Result<std::vector<PilotFigure>> sessionFigures(const StudyPerson& person, const AnalysedSession& one, bool massager) {
    const auto& session = one.session->results;
    const auto found = detectionIn(session, massager);
    if (!found) return failure(found);
    Figures all(fmt::format("{}-session-{}", person.code(), session.number),
                QString("%1, session %2: ").arg(qtext(person.name())).arg(session.number), person.simulated());
    if (!*found) return all.take();
    const auto& detection = **found;
    const auto unit = massager ? QString() : QString(" mA");
    all.add("function", "psychometric function", functionFigure(detection, massager),
            QString("Detection: %1 trials%2; threshold %3%4. A larger point is more trials.")
                .arg(QString::number(detection.answers.size()),
                     session.measurements > 1 ? QString(" of the last of %1 measurements").arg(session.measurements)
                                              : QString(),
                     intervalText(detection.course.threshold.back(), 2), unit));
    all.add("trace", "detection, trial by trial", traceFigure(detection, massager),
            "The estimate is QUEST+’s after each answer.");
    return all.take();
}

std::vector<PilotFigure> personFigures(const StudyPerson& person, bool massager) {
    Figures all(person.code(), qtext(person.name()), person.simulated());
    const double chance = chanceOf(person);
    QString slopes;
    auto learning = learningFigure(person, slopes);
    addChance(learning, chance);
    all.add("blocks", ": answers over blocks", std::move(learning),
            "Bands are Wilson’s 95 % interval of each block." + slopes);
    all.add("thresholds", ": thresholds over sessions and days", thresholdsFigure(person, massager));
    all.add("drift", ": thresholds within sessions", driftFigure(person, massager), "Bands are the 95 % interval.");
    auto accuracy = accuracyFigure(person);
    addChance(accuracy, chance);
    std::vector<LogisticPoint> days;
    for (const auto& one : person.sessions()) {
        if (one.found.all.n > 0 && std::isfinite(one.session->results.days))
            days.push_back({one.session->results.days, one.found.all.n, one.found.all.hits});
    }
    const auto trend = days.size() >= 3 ? logisticSlope(days) : Estimate();
    all.addCourse(
        "sessions", ": answers over sessions and days", std::move(accuracy),
        QString("Bars are Wilson’s 95 % interval.%1")
            .arg(std::isfinite(trend.value) ? QString(" Trend: %1 in log odds per day.").arg(intervalText(trend, 3))
                                            : QString()));
    all.add("response-times", ": response times of the test", responseFigure(person),
            "The share of answers given by a time; all sessions.");
    all.addCourse("response-sessions", ": response times over sessions", responsesOverSessions(person));
    return all.take();
}

Result<std::vector<PilotFigure>> peopleFigures(const std::vector<StudyPerson>& people, bool massager) {
    std::vector<std::pair<QString, PersonCourse>> blocks, sessions, ratios, times;
    std::vector<PersonEncodings> encodings;
    CurvesFigure functions;
    functions.x = levelAxis("Level", massager);
    functions.y = {kRight, "%", {}};
    double chance = kNaN;
    for (const auto& person : people) {
        const auto name = qtext(person.name());
        if (!std::isfinite(chance)) chance = chanceOf(person);
        blocks.emplace_back(name, accuracyOverBlocks(person));
        sessions.emplace_back(name, overSessions(person, accuracyIn));
        ratios.emplace_back(name, detectionRatios(person));
        times.emplace_back(name, overSessions(person, [](const AnalysedSession& one) {
                               return PersonValue{quantileOf(responseTimes(one.session->results), 0.5)};
                           }));
        encodings.push_back(person.encodings());
        for (const auto& one : person.sessions()) {
            const auto found = detectionIn(one.session->results, massager);
            if (!found) return failure(found);
            if (!*found) continue;
            auto curve = curveNamed(name);
            curve.x = (*found)->levels;
            for (const auto& share : (*found)->course.right) curve.y.push_back(kPercent * share.value);
            functions.curves.push_back(std::move(curve));
            break;  // the first session that has one
        }
    }
    const auto took = std::ranges::count_if(people, [](const auto& person) { return !person.sessions().empty(); });
    if (took < 2) return std::vector<PilotFigure>();
    const auto basis = people.front().basis();
    Figures all(basis == SessionBasis::Person    ? "people"
                : basis == SessionBasis::Virtual ? "virtual-participants"
                                                 : "people-on-simulated-devices",
                peopleHeading(basis), people.front().simulated());
    functions.lines = {{"threshold: 80 % right", 80}};
    all.add("functions", ": psychometric functions", std::move(functions),
            "Detection in each person’s first session with such trials.");
    auto learning = overPeople(blocks, Scale::Share);
    learning.x.label = "Block of the test";
    learning.y = {kRight, "%", {}};
    addChance(learning, chance);
    all.add("blocks", ": answers over blocks", std::move(learning),
            QString("All sessions of a person together. ") + kMeanNote);
    auto ratio = overPeople(ratios, Scale::LogRatio);
    ratio.x.label = "Session";
    ratio.y = {"Detection threshold, ratio to the first", "", {}};
    ratio.lines = {{"as in the first session", 1}};
    all.addCourse("thresholds", ": detection threshold over sessions", std::move(ratio), kMeanNote);
    auto accuracy = overPeople(sessions, Scale::Share);
    accuracy.x.label = "Session";
    accuracy.y = {kRight, "%", {}};
    addChance(accuracy, chance);
    all.addCourse("sessions", ": answers over sessions", std::move(accuracy), kMeanNote);
    auto response = overPeople(times, Scale::Plain);
    response.x.label = "Session";
    response.y = {"Median response time", "s", {}};
    all.addCourse("response-sessions", ": response times over sessions", std::move(response), kMeanNote);
    for (const auto& pair : compareEncodingsOver(std::move(encodings)).pairs) {
        CurvesFigure figure;
        auto differences = curveNamed("each person, Newcombe’s 95 % interval", true);
        for (const auto& person : pair.people) {
            figure.x.names << qtext(person.name);
            add(differences, static_cast<double>(figure.x.names.size()), person.accuracy, kPercent);
        }
        figure.curves.push_back(std::move(differences));
        const bool several = pair.people.size() > 1;
        if (several) {
            auto mean = curveNamed("mean over people, with its 95 % interval", true);
            figure.x.names << "mean";
            add(mean, static_cast<double>(figure.x.names.size()), pair.accuracy, kPercent);
            figure.curves.push_back(std::move(mean));
        }
        figure.x.label = "Participant";
        figure.y = {QString("Right, %1 minus %2").arg(qtext(pair.a), qtext(pair.b)), "points", {}};
        figure.lines = {{"no difference", 0}};
        all.add(fmt::format("{}-minus-{}", pair.a, pair.b).c_str(),
                QString(": %1 against %2").arg(qtext(pair.a), qtext(pair.b)), std::move(figure),
                several ? kMeanNote : "");
    }
    return all.take();
}

void addFigures(std::vector<ReportBlock>& blocks, Captions& captions, const std::vector<PilotFigure>& figures) {
    for (const auto& each : figures) {
        blocks.emplace_back(FigureBlock{captions.figure(each.caption, each.simulated), figureLegend(each.figure),
                                        drawFigure(each.figure, each.simulated)});
    }
}

Result<std::vector<PilotFigure>> pilotFigures(const StudyRecord& study) {
    const bool massager = study.settings.modality == Modality::Massager;
    std::vector<PilotFigure> all;
    const auto append = [&all](std::vector<PilotFigure> more) { std::ranges::move(more, std::back_inserter(all)); };
    for (const auto& [basis, part] : byBasis(study)) {
        std::vector<StudyPerson> people;
        for (const auto& participant : part.participants) {
            if (participant.about.state == ParticipantState::Withdrawn) continue;
            auto person = StudyPerson::analysed(participant);
            if (!person) return failure(person);
            people.push_back(std::move(*person));
        }
        auto together = peopleFigures(people, massager);
        if (!together) return together;
        append(std::move(*together));
        for (const auto& person : people) {
            append(personFigures(person, massager));
            for (const auto& one : person.sessions()) {
                auto figures = sessionFigures(person, one, massager);
                if (!figures) return figures;
                append(std::move(*figures));
            }
        }
    }
    return all;
}

Result<void> writeFigures(const std::vector<PilotFigure>& figures, const std::filesystem::path& folder) {
    if (auto fonts = requireFonts(fontInstalled); !fonts) return fonts;
    std::vector<BidsFile> files;
    for (const auto& each : figures) {
        const auto sheet = drawFigure(each.figure, each.simulated);
        files.push_back({each.name + ".svg", sheetSvg(*sheet, each.caption).toStdString()});
    }
    return writeBids(files, folder);
}

}  // namespace tacto
