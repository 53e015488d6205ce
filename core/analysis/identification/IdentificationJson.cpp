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

ResultRecord<EncodingResult> describeEncoding() {
    using E = EncodingResult;
    ResultRecord<E> all;
    all.kept("encoding", &E::encoding);
    all.kept("n", &E::n);
    all.kept("hits", &E::hits);
    all.kept("accuracy", [](const E& result) { return wilsonInterval(result.hits, result.n); });
    all.kept("training_blocks", &E::trainingBlocks);
    all.kept("median_rt_s", &E::medianResponse_s);
    all.kept("naturalness", &E::naturalness);
    all.kept("sessions", &E::sessions);
    all.kept("it_corrected_bits", in(&E::itCorrected_bits, &Estimate::value));
    all.kept("it_corrected_low_bits", in(&E::itCorrected_bits, &Estimate::low));
    all.kept("it_corrected_high_bits", in(&E::itCorrected_bits, &Estimate::high));
    return all;
}

ResultRecord<EncodingsOverPeople> describeOverPeople() {
    using O = EncodingsOverPeople;
    using P = PairOverPeople;
    ResultRecord<PersonEncodings> person;
    person.kept("name", &PersonEncodings::name);
    person.kept("encodings", &PersonEncodings::encodings, describeEncoding());
    ResultRecord<PersonDifference> difference;
    difference.kept("name", &PersonDifference::name);
    difference.kept("accuracy", &PersonDifference::accuracy);
    difference.kept("bits", &PersonDifference::bits);
    difference.kept("a_first", &PersonDifference::aFirst);
    ResultRecord<P> pair;
    pair.kept("a", &P::a);
    pair.kept("b", &P::b);
    pair.kept("people", &P::people, difference);
    pair.kept("accuracy", &P::accuracy);
    pair.kept("bits", &P::bits);
    pair.kept("a_better", &P::aBetter);
    pair.kept("b_better", &P::bBetter);
    pair.kept("exchange_p", &P::exchangeP);
    ResultRecord<O> all;
    all.kept("people", &O::people, person);
    all.kept("pairs", &O::pairs, pair);
    all.kept("better", nullIfEmpty(&O::better));
    all.kept("sentences", [](const O& found) { return encodingSentences(found); });
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
