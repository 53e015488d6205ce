#include "app/report/StudyReport.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/report/Captions.h"
#include "app/report/FigureDrawing.h"
#include "app/report/StudyFlow.h"
#include "app/report/StudyOverSessions.h"
#include "app/report/StudyPredicted.h"
#include "app/report/StudyPreferences.h"
#include "app/report/StudyText.h"
#include "app/report/StudyVibration.h"
#include "core/analysis/identification/Encodings.h"
#include "core/analysis/identification/FewPeople.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

QString qtext(const std::string& value) { return QString::fromStdString(value); }

std::vector<IdentificationTrial> trialsOf(const BidsSession& session) {
    std::vector<IdentificationTrial> trials;
    for (const auto& row : session.trials) trials.push_back(row.trial);
    return trials;
}

PresentedRange rangeOf(const BidsSession& session) {
    PresentedRange range;
    if (std::isfinite(session.low.value()) && std::isfinite(session.high.value())) {
        range.low = session.low;
        range.high = session.high;
        range.impedance = session.impedance;
        range.lowVoltage = Volts(session.low.value() * session.impedance.value() / 1000);
        range.highVoltage = Volts(session.high.value() * session.impedance.value() / 1000);
    }
    if (std::isfinite(session.lowIntensity) && std::isfinite(session.highIntensity)) {
        range.lowIntensity = session.lowIntensity;
        range.highIntensity = session.highIntensity;
    }
    return range;
}

double medianResponse_s(const BidsSession& session) {
    std::vector<double> times;
    for (const auto& row : session.trials) {
        if (row.trial.phase == TrialPhase::Test && std::isfinite(row.trial.rt_s)) times.push_back(row.trial.rt_s);
    }
    return statisticsOf(times).median;
}

/// In their order.
Result<std::vector<AnalysedSession>> analysedAll(const ParticipantRecord& participant) {
    std::vector<AnalysedSession> all;
    for (const auto& session : participant.sessions) {
        auto found = identify(trialsOf(session.results), session.results.labels);
        if (!found) return failure(found);
        all.push_back({&session, std::move(*found)});
    }
    return all;
}

/// Those with test trials.
Result<std::vector<AnalysedSession>> analysed(const ParticipantRecord& participant) {
    auto all = analysedAll(participant);
    if (all) std::erase_if(*all, [](const AnalysedSession& one) { return one.found.all.n == 0; });
    return all;
}

ReportContent begun(const StudyRecord& study, const QString& title, const QString& subtitle) {
    ReportContent content;
    content.simulated = sharedStudy(study).simulated;
    content.documentTitle = title;
    content.header =
        QString("Tactoscope " TACTOSCOPE_VERSION "  ·  %1%2").arg(title, content.simulated ? "  ·  simulated" : "");
    content.footer =
        QString("Study %1  ·  ledger head %2…").arg(qtext(study.settings.id), qtext(study.ledgerHead).left(12));
    content.blocks.emplace_back(TitleBlock{title, subtitle});
    if (study.settings.modality == Modality::Massager)
        content.blocks.emplace_back(ParagraphBlock{
            "Modality: massager. What was felt was the vibration of a motor; levels are its strength, from 0 to 1."});
    if (content.simulated) {
        content.blocks.emplace_back(ParagraphBlock{
            "SIMULATED: the participants are a model of people. These numbers say what the program does, "
            "not what people do."});
    }
    return content;
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
    facts.facts = {{"By chance", QString("p %1, exact and one-sided against %2 %")
                                     .arg(chance.startsWith('<') ? chance : "= " + chance)
                                     .arg(100 * found.all.chance, 0, 'f', 0)},
                   {"Information", QString("%1 bit, of which chance gives %2 bit; corrected %3 bit")
                                       .arg(figureText(found.all.it_bits, 2), figureText(found.all.itBias_bits, 2),
                                            figureText(found.all.itCorrected_bits, 2))}};
    for (const auto& [name, feature] :
         {std::pair{"Texture alone", &found.texture}, {"Pressure alone", &found.pressure}}) {
        if (!*feature) continue;
        const auto& figures = (*feature)->figures;
        facts.facts.push_back(
            {name, QString("%1 of %2, %3; corrected information %4 bit, d′ %5, criterion %6")
                       .arg(figures.hits)
                       .arg(figures.n)
                       .arg(shareText(figures.accuracy), figureText(figures.itCorrected_bits, 2),
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

void addEncodings(std::vector<ReportBlock>& blocks, Captions& captions, const std::string& name,
                  const std::vector<AnalysedSession>& sessions) {
    std::vector<EncodingResult> results;
    std::set<std::string> met;
    for (const auto& one : sessions) {
        const auto& encoding = one.session->results.encoding;
        if (!met.insert(encoding).second) continue;  // the first session with each
        std::set<std::size_t> training;
        for (const auto& row : one.session->results.trials) {
            if (row.trial.phase == TrialPhase::Training) training.insert(row.trial.block);
        }
        results.push_back({.encoding = encoding,
                           .n = one.found.all.n,
                           .hits = one.found.all.hits,
                           .trainingBlocks = training.size(),
                           .medianResponse_s = medianResponse_s(one.session->results),
                           .naturalness = naturalnessOf(one.session->results)});
    }
    if (results.size() < 2) return;
    const auto compared = compareEncodings(std::move(results));
    TableBlock table;
    table.caption = captions.table(qtext(name) + ": encodings, in the order in which the person had them");
    table.columns = {{"Encoding"},
                     {"Right", true},
                     {"Trials", true},
                     {"Training blocks", true},
                     {"Median response (s)", true},
                     {"Naturalness, 1 to 5", true}};
    for (const auto& each : compared.encodings) {
        table.rows.push_back({qtext(each.encoding), QString::number(each.hits), QString::number(each.n),
                              QString::number(each.trainingBlocks), figureText(each.medianResponse_s, 2),
                              figureText(each.naturalness, 1)});
    }
    blocks.emplace_back(std::move(table));
    for (const auto& pair : compared.pairs) {
        blocks.emplace_back(
            ParagraphBlock{QString("%1 minus %2: %3 percentage points (Newcombe).")
                               .arg(qtext(pair.a), qtext(pair.b), shareText(pair.difference).remove(" %"))});
    }
}

void addTogether(std::vector<ReportBlock>& blocks, Captions& captions, std::vector<PersonResult> people) {
    blocks.emplace_back(captions.heading("All participants"));
    const auto together = judgeFewPeople(std::move(people));
    TableBlock table;
    table.caption = captions.table("Each participant's first session with test trials, else the last");
    table.columns = {{"Participant"},          {"Usable range"},      {"Right", true},
                     {"Accuracy, 95 %", true}, {"p by chance", true}, {"Information, corrected (bit)", true}};
    for (const auto& person : together.people) {
        const auto& figures = person.figures;
        table.rows.push_back({qtext(person.name), person.usable ? "yes" : "no",
                              QString("%1 of %2").arg(figures.hits).arg(figures.n), shareText(figures.accuracy),
                              qtext(chanceText(figures.n > 0 ? figures.pChance : kNaN)),
                              figureText(figures.itCorrected_bits, 2)});
    }
    blocks.emplace_back(std::move(table));
    blocks.emplace_back(ParagraphBlock{QString("Median accuracy %1 %, from %2 to %3 %.")
                                           .arg(figureText(100 * together.accuracy.median, 0),
                                                figureText(100 * together.accuracy.min, 0),
                                                figureText(100 * together.accuracy.max, 0))});
    blocks.emplace_back(ParagraphBlock{qtext(fewPeopleSentence(together))});
    blocks.emplace_back(ParagraphBlock{
        "Answers of different people are not pooled: no proportion, p or interval is given over all trials.", true});
}

/// A sentence for each session in which there was no room for the test.
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

void addApproval(std::vector<ReportBlock>& blocks, Captions& captions, const StudyRecord& study) {
    blocks.emplace_back(captions.heading("Approval and consent"));
    blocks.emplace_back(approvalFacts(study));
    blocks.emplace_back(captions.heading("What the approval covers"));
    blocks.emplace_back(procedureFacts(study));
}

const ParticipantRecord* withCode(const StudyRecord& study, const std::string& code) {
    for (const auto& participant : study.participants) {
        if (!participant.about.code.empty() && participant.about.code == code) return &participant;
    }
    return nullptr;
}

/// As they measured it last.
double amplitudeWeberOf(const ParticipantRecord& participant) {
    double weber = kNaN;
    for (const auto& session : participant.sessions) {
        if (std::isfinite(session.results.amplitudeWeber)) weber = session.results.amplitudeWeber;
    }
    return weber;
}

Result<void> addOver(std::vector<ReportBlock>& blocks, Captions& captions, const StudyRecord& study,
                     const std::string& code) {
    const auto* participant = withCode(study, code);
    if (participant == nullptr) return {};
    const auto sessions = analysedAll(*participant);
    if (!sessions) return failure(sessions);
    return addOverSessions(blocks, captions, code, *sessions, study.settings.modality == Modality::Massager);
}

}  // namespace

Result<ReportContent> studyReport(const StudyRecord& study) {
    auto content = begun(study, qtext(study.settings.title), "Pilot study  ·  for those who run it: names codes");
    auto& blocks = content.blocks;
    const bool massager = study.settings.modality == Modality::Massager;
    Captions captions(content.simulated);
    std::vector<PersonResult> people;
    std::vector<std::pair<std::string, std::vector<AnalysedSession>>> all;
    for (const auto& participant : study.participants) {
        if (participant.about.state == ParticipantState::Withdrawn) continue;
        auto sessions = analysed(participant);
        if (!sessions) return failure(sessions);
        if (!participant.sessions.empty()) {
            PersonResult person{.name = participant.about.code, .usable = true, .figures = {}};
            if (sessions->empty())
                person.usable = hasUsableRange(participant.sessions.back().results);
            else
                person.figures = sessions->front().found.all;
            people.push_back(std::move(person));
        }
        all.emplace_back(participant.about.code, std::move(*sessions));
    }
    for (const auto& [name, sessions] : all) {
        for (const auto& one : sessions)
            blocks.emplace_back(ParagraphBlock{qtext(headline(name, one.found, rangeOf(one.session->results)))});
    }
    addTogether(blocks, captions, std::move(people));
    for (const auto& [name, sessions] : all) {
        const auto* who = withCode(study, name);
        const auto unusable = who == nullptr ? QStringList() : unusableRanges(*who);
        if (sessions.empty() && unusable.empty() && (who == nullptr || who->sessions.size() < 2)) continue;
        blocks.emplace_back(captions.heading(qtext(name)));
        for (const auto& sentence : unusable) blocks.emplace_back(ParagraphBlock{sentence});
        for (const auto& one : sessions) {
            const auto& results = one.session->results;
            addConfusion(blocks, captions, one,
                         QString("%1, session %2, encoding %3: presented and answered")
                             .arg(qtext(name))
                             .arg(results.number)
                             .arg(qtext(results.encoding)),
                         content.simulated);
            addFacts(blocks, one);
            const auto predicted = QString("%1, session %2: predicted from the detection threshold, and answered")
                                       .arg(qtext(name))
                                       .arg(results.number);
            const double weber = who == nullptr ? kNaN : amplitudeWeberOf(*who);
            if (auto added = addPredicted(blocks, captions, predicted, one, weber, massager); !added)
                return failure(added);
            addRatings(blocks, captions, results, name);
            if (massager) {
                if (auto added = addVibration(blocks, captions, results, name); !added) return failure(added);
            }
        }
        addEncodings(blocks, captions, name, sessions);
        if (who != nullptr && !preferenceText(*who).isEmpty())
            blocks.emplace_back(ParagraphBlock{preferenceText(*who)});
        if (auto added = addOver(blocks, captions, study, name); !added) return failure(added);
    }
    if (auto table = preferencesTable(study)) {
        blocks.emplace_back(captions.heading("Preferred encodings"));
        table->caption = captions.table("How many participants prefer which encoding");
        blocks.emplace_back(std::move(*table));
        blocks.emplace_back(ParagraphBlock{preferencesNote(study)});
    }
    blocks.emplace_back(captions.heading("Drift and exposure"));
    blocks.emplace_back(courseTable(study, ShownName::Code, captions.table("Drift and exposure, a row a session")));
    blocks.emplace_back(captions.heading("Side effects"));
    blocks.emplace_back(sideEffectsTable(study, ShownName::Code, captions.table("Side effects, a row a session")));
    blocks.emplace_back(captions.heading("Flow of participants"));
    blocks.emplace_back(flowTable(study, captions.table("From enrolment to result")));
    addApproval(blocks, captions, study);
    return content;
}

ReportContent committeeReport(const StudyRecord& study) {
    auto content = begun(study, qtext(study.settings.title), "Report to the ethics committee  ·  names no participant");
    auto& blocks = content.blocks;
    Captions captions(content.simulated);
    addApproval(blocks, captions, study);
    blocks.emplace_back(captions.heading("Flow of participants"));
    blocks.emplace_back(flowTable(study, captions.table("From enrolment to result")));
    blocks.emplace_back(captions.heading("Sessions"));
    blocks.emplace_back(careTable(study, captions.table("Stimulation, stops and skin, a row a session")));
    blocks.emplace_back(courseTable(study, ShownName::Label, captions.table("Drift and exposure, a row a session")));
    blocks.emplace_back(refusalsTable(study, captions.table("Checks that did not hold")));
    blocks.emplace_back(captions.heading("Side effects"));
    blocks.emplace_back(sideEffectsTable(study, ShownName::Label, captions.table("Side effects, a row a session")));
    blocks.emplace_back(captions.heading("Adverse events"));
    if (study.events.empty()) {
        blocks.emplace_back(ParagraphBlock{"None was recorded."});
    } else {
        blocks.emplace_back(eventsTable(study, captions.table("Adverse events")));
    }
    blocks.emplace_back(
        SignaturesBlock{{"Principal investigator"}, {"Name", "Date", "Signature"}, {QString("not recorded")}});
    return content;
}

Result<ReportContent> participantReport(const StudyRecord& study, const std::string& code) {
    const auto* participant = withCode(study, code);
    if (participant == nullptr) return fail(ErrorCode::NotFound, "no participant of this study has the code {}", code);
    const auto sessions = analysed(*participant);
    if (!sessions) return failure(sessions);
    auto content = begun(study, qtext(study.settings.title), "What you felt  ·  for the participant");
    auto& blocks = content.blocks;
    const bool massager = study.settings.modality == Modality::Massager;
    blocks.emplace_back(ParagraphBlock{
        QString("Thank you for taking part. You felt four kinds of touch, made by short %1 on your skin: rough or "
                "smooth, firm or light. After each one you said which it was.")
            .arg(massager ? "vibrations" : "pulses")});
    for (const auto& one : *sessions) {
        const auto& all = one.found.all;
        blocks.emplace_back(ParagraphBlock{
            QString(
                "Session %1: you were right %2 times out of %3, which is %4 %. Guessing would be right about %5 times.")
                .arg(one.session->results.number)
                .arg(all.hits)
                .arg(all.n)
                .arg(100 * all.accuracy.value, 0, 'f', 0)
                .arg(all.chance * static_cast<double>(all.n), 0, 'f', 0)});
        if (one.found.texture && one.found.pressure) {
            blocks.emplace_back(
                ParagraphBlock{QString("You told rough from smooth %1 times, and firm from light %2 times.")
                                   .arg(one.found.texture->figures.hits)
                                   .arg(one.found.pressure->figures.hits)});
        }
    }
    if (sessions->empty()) {
        blocks.emplace_back(
            ParagraphBlock{"Your sessions did not get to the part in which you name them. That happens, and it is a "
                           "result too."});
    }
    blocks.emplace_back(ParagraphBlock{
        QString("This says nothing about your health or your skill. Some people feel such %1 clearly and others do "
                "not; finding out is why the study is done. You may ask for your data to be destroyed, or stop taking "
                "part, as your consent form says.")
            .arg(massager ? "vibrations" : "pulses")});
    content.footer = "Tactoscope";
    return content;
}

}  // namespace tacto
