#include "core/analysis/identification/IdentificationJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"
#include "core/results/ResultRecord.h"

namespace tacto {

using nlohmann::json;

namespace {

using namespace describe;

json medianAndRange(const Statistics& of) {
    return {{"median", numberOrNull(of.median)}, {"min", numberOrNull(of.min)}, {"max", numberOrNull(of.max)}};
}

ResultRecord<ConfusionFigures> describeFigures() {
    using F = ConfusionFigures;
    const auto bits = &F::itCorrected_bits;
    ResultRecord<F> all;
    all.shown(text("Of", "of"));  // all conditions, or one feature of them
    all.shown(number("Right", "hits"), &F::hits);
    all.shown(number("n", "n"), &F::n);
    all.shown(as(As::Share, "Share", "accuracy"), &F::accuracy);
    all.shown(as(As::Chance, "By chance, p", "p_chance"), &F::pChance);
    all.kept("it_bits", &F::it_bits);
    all.kept("it_bias_bits", [](const F& figures) { return figures.it_bits - figures.itCorrected_bits.value; });
    all.shown(number("Corrected information", "it_corrected_bits", "bit"), in(bits, &Estimate::value));
    all.shown(number("95 % from", "it_corrected_low_bits", "bit"), in(bits, &Estimate::low));
    all.shown(number("to", "it_corrected_high_bits", "bit"), in(bits, &Estimate::high));
    return all;
}

ResultRecord<FeatureFigures> describeFeature() {
    using F = FeatureFigures;
    ResultRecord<F> all;
    all.merge(&F::figures, describeFigures());
    all.kept("values", &F::values);
    all.kept("confusion", &F::confusion);
    all.kept("d_prime", &F::dPrime);
    all.kept("criterion", &F::criterion);
    return all;
}

ResultRecord<BlockFigures> describeBlock() {
    using B = BlockFigures;
    ResultRecord<B> all;
    all.kept("block", &B::block);
    all.kept("n", &B::n);
    all.kept("hits", &B::hits);
    return all;
}

ResultRecord<BlockFigures> describeSequence() {
    using B = BlockFigures;
    ResultRecord<B> all;
    all.kept("n", &B::n);
    all.kept("hits", &B::hits);
    all.kept("accuracy", [](const B& after) { return wilsonInterval(after.hits, after.n); });
    return all;
}

ResultRecord<AnswerShare> describeShare() {
    using S = AnswerShare;
    ResultRecord<S> all;
    all.kept("response", &S::response);
    all.kept("n", &S::n);
    all.kept("share", &S::share);
    return all;
}

ResultRecord<Identification> describeIdentification() {
    using I = Identification;
    ResultRecord<I> all;
    all.merge(&I::all, describeFigures());
    all.kept("labels", &I::labels);
    all.kept("columns", &I::columns);
    all.kept("confusion", &I::confusion);
    all.table(confusion("Given, and answered"));
    all.kept("texture", &I::texture, describeFeature());
    all.kept("pressure", &I::pressure, describeFeature());
    all.table(rows("Conditions told apart", "|texture|pressure", describeFigures().columns()));
    all.shown(number("Nothing was given", "catch.n"), in(&I::catches, &CatchFigures::n));
    all.shown(number("It was named as something", "catch.false_alarms"), in(&I::catches, &CatchFigures::falseAlarms));
    all.kept("catch.rate", in(&I::catches, &CatchFigures::rate));
    all.shown(number("No answer, in all trials", "no_answer"), &I::noAnswer);
    all.facts("Catch trials");
    all.kept("blocks", &I::blocks, describeBlock());
    all.kept("shares", &I::shares, describeShare());
    all.kept("learning", &I::learning);
    all.kept("sequence.after_same", &I::afterSame, describeSequence());
    all.kept("sequence.after_other", &I::afterOther, describeSequence());
    all.kept("median_rt_s", &I::medianResponseTime_s);
    return all;
}

/// One person's results with one encoding, with the person's name.
struct EncodingRow {
    std::string participant;
    EncodingResult result;
};

ResultRecord<EncodingRow> describeEncoding() {
    using E = EncodingResult;
    ResultRecord<EncodingRow> row;
    const auto of = [](auto member) { return in(&EncodingRow::result, member); };
    row.shown(text("Participant", "participant"), &EncodingRow::participant);
    row.shown(text("Encoding", "encoding"), of(&E::encoding));
    row.shown(number("Sessions", "sessions"), of(&E::sessions));
    row.shown(number("Right", "hits"), of(&E::hits));
    row.shown(number("n", "n"), of(&E::n));
    row.shown(as(As::Share, "Share", "accuracy"),
              [](const EncodingRow& each) { return wilsonInterval(each.result.hits, each.result.n); });
    row.shown(number("Corrected information", "information", "bit"), of(&E::itCorrected_bits));
    row.kept("training_blocks", of(&E::trainingBlocks));
    row.kept("median_rt_s", of(&E::medianResponse_s));
    row.kept("naturalness", of(&E::naturalness));
    return row;
}

/// One person's difference of two encodings, or the mean over people.
struct DifferenceRow {
    std::string of, participant, first;
    Estimate accuracy, bits;
    double p = kNaN;
};

ResultRecord<DifferenceRow> describeDifference() {
    using D = DifferenceRow;
    ResultRecord<D> all;
    all.shown(text("Participant", "participant"), &D::participant);
    all.shown(text("Difference", "of"), &D::of);
    all.shown(number("Right (percentage points)", "points"), [](const D& row) {
        return Estimate{100 * row.accuracy.value, 100 * row.accuracy.low, 100 * row.accuracy.high};
    });
    all.shown(number("Information", "bits", "bit"), &D::bits);
    all.kept("first", nullIfEmpty(&D::first));
    all.shown(as(As::Chance, "By exchange, p", "p"), &D::p);
    return all;
}

std::vector<EncodingRow> encodingRows(const EncodingsOverPeople& found) {
    std::vector<EncodingRow> rows;
    for (const auto& person : found.people) {
        for (const auto& each : person.encodings) rows.push_back({person.name, each});
    }
    return rows;
}

std::vector<DifferenceRow> differenceRows(const EncodingsOverPeople& found) {
    std::vector<DifferenceRow> rows;
    for (const auto& pair : found.pairs) {
        const auto of = fmt::format("{} minus {}", pair.a, pair.b);
        for (const auto& person : pair.people)
            rows.push_back({of, person.name, person.aFirst ? pair.a : pair.b, person.accuracy, {person.bits}, kNaN});
        if (pair.people.size() > 1) rows.push_back({of, "mean", {}, pair.accuracy, pair.bits, pair.exchangeP});
    }
    return rows;
}

ResultRecord<EncodingsOverPeople> describeOverPeople() {
    using O = EncodingsOverPeople;
    ResultRecord<O> all;
    all.table(sentences("Which encoding is better", "sentences"));
    all.rows("Each participant with each encoding, all sessions together", "encodings", encodingRows,
             describeEncoding());
    all.rows("Differences within person", "differences", differenceRows, describeDifference());
    all.table(rows(
        "Training, response times and ratings with each encoding", "encodings",
        {text("Participant", "participant"), text("Encoding", "encoding"), number("Training blocks", "training_blocks"),
         number("Median response", "median_rt_s", "s"), number("Naturalness, 1 to 5", "naturalness")}));
    all.kept("better", nullIfEmpty(&O::better));
    all.kept("sentences", [](const O& found) {
        auto said = encodingSentences(found);
        if (auto set = assignmentSentence(found); !set.empty()) said.push_back(std::move(set));
        return said;
    });
    return all;
}

ResultRecord<SessionFigures> describeSession() {
    using S = SessionFigures;
    ResultRecord<S> all;
    all.shown(text("Participant", "participant"), &S::participant);
    all.shown(number("Session", "number"), &S::number);
    all.shown(number("Day", "days"), &S::days);
    all.shown(text("Encoding", "encoding"), nullIfEmpty(&S::encoding));
    all.kept("detection", &S::detection);
    all.kept("too_strong", &S::tooStrong);
    all.kept("low", &S::low);
    all.kept("high", &S::high);
    all.shown(number("Right", "hits"), &S::hits);
    all.shown(number("n", "n"), &S::n);
    all.shown(as(As::Share, "Share", "accuracy"),
              [](const S& session) { return session.n > 0 ? wilsonInterval(session.hits, session.n) : Estimate(); });
    all.shown(number("Corrected information", "information", "bit"), &S::itCorrected_bits);
    all.kept("median_rt_s", &S::medianResponse_s);
    all.kept("impedance_ohm", [](const S& session) { return session.impedance.value(); });
    return all;
}

ResultRecord<StudyFigures> describeStudy() {
    using F = StudyFigures;
    ResultRecord<F> all;
    const auto& encodings = describeOverPeople();
    all.merge(&F::encodings, encodings);
    all.table(encodings.tables().front());  // the sentences come first
    all.rows("Sessions", "sessions", &F::sessions, describeSession());
    all.table(rows("Thresholds in each session", "sessions",
                   {text("Participant", "participant"), number("Session", "number"),
                    number("Detection", "detection", "@unit"), number("Too strong from", "too_strong", "@unit"),
                    number("Range, from", "low", "@unit"), number("to", "high", "@unit")}));
    for (std::size_t i = 1; i < encodings.tables().size(); ++i) all.table(encodings.tables()[i]);
    return all;
}

ResultRecord<FewPeople> describePeople() {
    using P = FewPeople;
    ResultRecord<PersonResult> person;
    person.merge(&PersonResult::figures, describeFigures());
    person.kept("name", &PersonResult::name);
    person.kept("usable", &PersonResult::usable);
    ResultRecord<PersonLeftOut> leftOut;
    leftOut.kept("name", &PersonLeftOut::name);
    leftOut.kept("reason", &PersonLeftOut::reason);
    ResultRecord<P> all;
    all.kept("people", &P::people, person);
    all.kept("left_out", &P::leftOut, leftOut);
    all.kept("accuracy", [](const P& people) { return medianAndRange(people.accuracy); });
    all.kept("it_corrected_bits", [](const P& people) { return medianAndRange(people.itCorrected_bits); });
    all.kept("above_chance.k", &P::aboveChance);
    all.kept("above_chance.n", [](const P& people) { return people.people.size(); });
    all.kept("above_chance.share", &P::share);
    all.kept("above_chance.prevalence", &P::prevalence);
    all.kept("above_chance.prevalence_at_least", in(&P::prevalence, &Estimate::low));
    return all;
}

/// The fields of a trial within a result.
RecordFields<IdentificationTrial> answerFields() {
    using T = IdentificationTrial;
    RecordFields<T> all;
    all.number("number", &T::number);
    all.word("phase", &T::phase, kTrialPhases);
    all.number("block", &T::block);
    all.text("condition", &T::condition, {.mayBeEmpty = true});
    all.add("response", &T::response, textOrNullKind());
    all.number("attempt", &T::attempt);
    all.number("rt_s", &T::rt_s);
    all.passOverUnknownKeys();
    return all;
}

/// The fields of a trial in a session's row: those of a result, and more.
RecordFields<IdentificationTrial> trialFields() {
    using T = IdentificationTrial;
    auto all = answerFields();
    all.number("current_ma", &T::current);
    all.number("interval_s", &T::interval_s);
    all.number("trains", &T::trains);
    return all;
}

}  // namespace

json toJson(const ConfusionFigures& figures) { return builtOnce<describeFigures>().write(figures); }

json toJson(const Identification& found) { return builtOnce<describeIdentification>().write(found); }

json toJson(const FewPeople& people) { return builtOnce<describePeople>().write(people); }

json toJson(const EncodingsOverPeople& found) { return builtOnce<describeOverPeople>().write(found); }

json toJson(const StudyFigures& found) {
    auto out = builtOnce<describeStudy>().write(found);
    out["kind"] = "study-results";
    for (auto& session : out["sessions"]) session["unit"] = found.massager ? "" : "mA";
    return out;
}

ResultTraits studyFiguresKind() { return {.name = "study-results", .tables = builtOnce<describeStudy>().tables()}; }

const std::vector<ResultTable>& identificationTables() { return builtOnce<describeIdentification>().tables(); }

Estimate correctedBitsFrom(const json& figures) {
    return {numberOr(figures, "it_corrected_bits"), numberOr(figures, "it_corrected_low_bits"),
            numberOr(figures, "it_corrected_high_bits")};
}

json toJson(const IdentificationTrial& trial) { return builtOnce<answerFields>().write(trial); }

IdentificationTrial identificationTrialFrom(const json& row) {
    return builtOnce<trialFields>().read(row, {.lenient = true}).value_or(IdentificationTrial{});
}

}  // namespace tacto
