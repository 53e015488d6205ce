#include "app/report/StudyPerson.h"

#include <algorithm>
#include <cmath>

#include "app/report/FigureDrawing.h"
#include "app/report/PilotFigures.h"
#include "app/report/StudyOverSessions.h"
#include "app/report/StudyText.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/vibration/VibrationSeparability.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

PresentedRange rangeOf(const BidsSession& session) {
    PresentedRange range;
    if (std::isfinite(session.low.value()) && std::isfinite(session.high.value())) {
        range.low = session.low;
        range.high = session.high;
        range.impedance = session.rangeImpedance;
        range.lowVoltage = Volts(session.low.value() * session.rangeImpedance.value() / 1000);
        range.highVoltage = Volts(session.high.value() * session.rangeImpedance.value() / 1000);
    }
    if (std::isfinite(session.lowIntensity) && std::isfinite(session.highIntensity)) {
        range.lowIntensity = session.lowIntensity;
        range.highIntensity = session.highIntensity;
    }
    return range;
}

void addConfusion(std::vector<ReportBlock>& blocks, Captions& captions, const AnalysedSession& one,
                  const QString& caption, bool simulated) {
    ConfusionFigure figure;
    figure.answers = "answered";
    for (const auto& label : one.found.labels) figure.labels << qtext(label);
    for (const auto& column : one.found.columns) figure.columns << qtext(column);
    for (const auto& row : one.found.confusion) figure.counts.emplace_back(row.begin(), row.end());
    figure.accuracy = one.found.all.accuracy;
    const Figure drawn{figure, {}};
    blocks.emplace_back(
        FigureBlock{captions.figure(caption, simulated), figureLegend(drawn), drawFigure(drawn, simulated)});
}

QString learningText(const Identification& found) {
    if (!std::isfinite(found.learning.value)) return "cannot be determined";
    return QString("%1 (%2 to %3) in log odds per block")
        .arg(figureText(found.learning.value, 2), figureText(found.learning.low, 2),
             figureText(found.learning.high, 2));
}

void addFacts(std::vector<ReportBlock>& blocks, const AnalysedSession& one) {
    const auto& found = one.found;
    FactsBlock facts;
    facts.oneColumn = true;
    const auto chance = qtext(chanceText(found.all.pChance));
    facts.facts = {
        {"By chance", QString("p %1, exact and one-sided against %2 %")
                          .arg(chance.startsWith('<') ? chance : "= " + chance)
                          .arg(100 * found.all.chance, 0, 'f', 0)},
        {"Information",
         QString("%1 bit without what chance adds, 95 % interval").arg(qtext(bitsText(found.all.itCorrected_bits)))}};
    for (const auto& [name, feature] :
         {std::pair{"Texture alone", &found.texture}, {"Pressure alone", &found.pressure}}) {
        if (!*feature) continue;
        const auto& figures = (*feature)->figures;
        facts.facts.push_back(
            {name, QString("%1 of %2, %3; corrected information %4 bit, d′ %5, criterion %6")
                       .arg(figures.hits)
                       .arg(figures.n)
                       .arg(shareText(figures.accuracy), qtext(bitsText(figures.itCorrected_bits)),
                            figureText((*feature)->dPrime, 2), figureText((*feature)->criterion, 2))});
    }
    facts.facts.push_back({"Catch trials", QString("%1 of %2 answered with a name, exact 95 % interval up to %3 %")
                                               .arg(found.catches.falseAlarms)
                                               .arg(found.catches.n)
                                               .arg(100 * found.catches.rate.high, 0, 'f', 0)});
    facts.facts.push_back({"Learning over blocks", learningText(found)});
    facts.facts.push_back(
        {"After the same condition", shareText(wilsonInterval(found.afterSame.hits, found.afterSame.n))});
    facts.facts.push_back({"After another", shareText(wilsonInterval(found.afterOther.hits, found.afterOther.n))});
    facts.facts.push_back({"Precision", qtext(precisionSentence(found.all.n, found.all.chance))});
    if (found.noAnswer > 0) facts.facts.push_back({"Without an answer", QString("%1 trial(s)").arg(found.noAnswer)});
    blocks.emplace_back(std::move(facts));
}

void addRatings(std::vector<ReportBlock>& blocks, Captions& captions, const BidsSession& session,
                const std::string& name) {
    if (session.ratings.empty()) return;
    constexpr std::string_view kItems[] = {"intensity", "unpleasantness", "pain", "naturalness", "qualities"};
    TableBlock table;
    table.caption = captions.table(QString("%1, session %2: ratings").arg(qtext(name)).arg(session.number));
    table.columns = {
        {"Condition"}, {"Intensity, 0 to 10", true}, {"Unpleasantness", true}, {"Pain", true}, {"Naturalness"},
        {"Felt like"}};
    for (const auto& label : session.labels) {
        QStringList row = {qtext(label)};
        for (const auto item : kItems) {
            const auto rated = std::ranges::find_if(session.ratings, [&](const BidsRating& rating) {
                return rating.condition == label && rating.item == item;
            });
            const bool isRated = rated != session.ratings.end() && !rated->value.empty();
            row << (isRated ? qtext(rated->value).replace(',', ", ").replace('-', ' ') : QString("–"));
        }
        table.rows.push_back(std::move(row));
    }
    blocks.emplace_back(std::move(table));
}

/// Returns a sentence for each session in which the usable range was too small for the test.
QStringList unusableRanges(const ParticipantRecord& participant) {
    QStringList said;
    for (const auto& session : participant.sessions) {
        if (session.results.rangeNotUsable.empty()) continue;
        said << QString("Session %1 had no usable range, and so no test: %2.")
                    .arg(session.results.number)
                    .arg(qtext(session.results.rangeNotUsable));
    }
    return said;
}

/// Returns the Weber fraction that was measured last.
double amplitudeWeberOf(const ParticipantRecord& participant) {
    double weber = kNaN;
    for (const auto& session : participant.sessions) {
        if (std::isfinite(session.results.amplitudeWeber)) weber = session.results.amplitudeWeber;
    }
    return weber;
}

}  // namespace

Result<StudyPerson> StudyPerson::analysed(const ParticipantRecord& participant) {
    StudyPerson made(participant);
    auto sessions = analysedSessions(participant);
    if (!sessions) return failure(sessions);
    made.sessions_ = std::move(*sessions);
    return made;
}

std::vector<AnalysedSession> StudyPerson::tested() const {
    auto all = sessions_;
    std::erase_if(all, [](const AnalysedSession& one) { return one.found.all.n == 0; });
    return all;
}

PersonResult StudyPerson::result() const {
    PersonResult person{.name = name(), .usable = true, .figures = {}};
    const auto sessions = tested();
    if (sessions.empty())
        person.usable = hasUsableRange(participant_->sessions.back().results);
    else
        person.figures = sessions.front().found.all;
    if (!sessions.empty()) person.encoding = sessions.front().session->results.encoding;
    return person;
}

PersonEncodings StudyPerson::encodings() const { return personEncodings(sessions_, name()); }

void StudyPerson::addHeadlines(std::vector<ReportBlock>& blocks) const {
    for (const auto& one : tested())
        blocks.emplace_back(ParagraphBlock{qtext(headline(name(), one.found, rangeOf(one.session->results)))});
}

Result<void> StudyPerson::add(std::vector<ReportBlock>& blocks, Captions& captions, Modality modality) const {
    const bool massager = modality == Modality::Massager;
    const auto unusable = unusableRanges(*participant_);
    const auto figures = personFigures(*this, massager);
    if (figures.empty() && unusable.empty()) return {};
    blocks.emplace_back(captions.heading(qtext(name())));
    for (const auto& sentence : unusable) blocks.emplace_back(ParagraphBlock{sentence});
    for (const auto& one : sessions_) {
        if (one.found.all.n > 0) {
            if (auto added = addSession(blocks, captions, one, massager); !added) return added;
        }
        const auto ofSession = sessionFigures(*this, one, massager);
        if (!ofSession) return failure(ofSession);
        addFigures(blocks, captions, *ofSession);
    }
    if (const auto preferred = preferenceText(*participant_); !preferred.isEmpty())
        blocks.emplace_back(ParagraphBlock{preferred});
    addFigures(blocks, captions, figures);
    return addOverSessions(blocks, captions, name(), sessions_, massager);
}

Result<void> StudyPerson::addSession(std::vector<ReportBlock>& blocks, Captions& captions, const AnalysedSession& one,
                                     bool massager) const {
    const auto& results = one.session->results;
    const auto caption = [&](const QString& what) {
        return QString("%1, session %2%3").arg(qtext(name())).arg(results.number).arg(what);
    };
    addConfusion(blocks, captions, one,
                 caption(QString(", encoding %1: presented and answered").arg(qtext(results.encoding))), simulated());
    addFacts(blocks, one);
    const auto predicted = caption(": predicted from the detection threshold, and answered");
    if (auto added = addPredicted(blocks, captions, predicted, one, amplitudeWeberOf(*participant_), massager); !added)
        return added;
    addRatings(blocks, captions, results, name());
    return massager ? addVibration(blocks, captions, results, name()) : Result<void>();
}

namespace {

std::vector<VibrationTrial> vibrationsOf(const BidsSession& session) {
    std::vector<VibrationTrial> all;
    for (const auto& row : session.trials) {
        if (row.trial.condition == kCatchCondition) continue;
        all.push_back({row.trial.condition, row.intensity, row.trial.interval_s, row.vibration});
    }
    return all;
}

}  // namespace

Result<void> addVibration(std::vector<ReportBlock>& blocks, Captions& captions, const BidsSession& session,
                          const std::string& name) {
    const auto judged = judgeVibration(vibrationsOf(session), session.labels);
    if (!judged) return failure(judged);
    if (!judged->measured) {
        for (const auto& reason : judged->reasons)
            blocks.emplace_back(ParagraphBlock{QString::fromStdString("What the massager did: " + reason)});
        return {};
    }
    TableBlock table;
    table.caption = captions.table(
        QString("%1, session %2: what the motor did, by the accelerometer on it; means over presentations")
            .arg(QString::fromStdString(name))
            .arg(session.number));
    table.columns = {{"Condition"},
                     {"Told: strength", true},
                     {"Told: interval (s)", true},
                     {"Acceleration, RMS (m/s²)", true},
                     {"Interval (s)", true},
                     {"Latency (ms)", true},
                     {"Rise, 10 to 90 % (ms)", true},
                     {"Moved in", true}};
    for (const auto& each : judged->conditions) {
        table.rows.push_back({QString::fromStdString(each.name), figureText(each.intensity, 2),
                              figureText(each.interval_s, 2), figureText(each.strength_m_s2.mean, 2),
                              figureText(each.measuredInterval_s.mean, 3), figureText(1e3 * each.latency_s.mean, 1),
                              figureText(1e3 * each.rise_s.mean, 1),
                              QString("%1 of %2 vibrations").arg(each.moved).arg(each.bursts - each.missed)});
    }
    blocks.emplace_back(std::move(table));
    QString said = QString("Whether the four are apart, by the rule that electrical conditions are judged by: %1.")
                       .arg(QString::fromStdString(std::string(nameOf(judged->verdict))));
    for (const auto& reason : judged->reasons) said += ' ' + QString::fromStdString(reason);
    blocks.emplace_back(ParagraphBlock{said});
    return {};
}

}  // namespace tacto
