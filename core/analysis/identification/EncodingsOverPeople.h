// EncodingsOverPeople.h - decides from people which of several encodings is told apart better.
//
// Within person: all sessions of one person with one encoding are one sample (their tables are added), and a person's
// difference is the accuracy with one encoding minus the accuracy with the other. Over people: the mean of these
// differences and its 95 % interval, ± t(n − 1) times the standard error. The standard error is the larger of the one
// from the spread of the differences and the one that the trials alone give, as in the modified interval of Knapp and
// Hartung (2003, Stat Med 22:2693): three people who agree by chance do not give an interval of no width. The interval
// assumes that such differences are normally distributed over people; with several pairs each interval is that of
// Bonferroni. The exact p of exchanging the encodings within each person assumes nothing, and is at least 2/2^n.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/OverSessions.h"

namespace tacto {

/// One session of a person.
struct EncodedSession {
    std::string encoding;
    const Identification* found = nullptr;
    std::size_t trainingBlocks = 0;
    std::vector<double> response_s = {};  ///< response times of the answered test trials
    double naturalness = kNaN;
};

/// Adds the sessions of each encoding; returns the encodings in the order of first use. Sessions without test trials or
/// without the name of an encoding are left out.
[[nodiscard]] std::vector<EncodingResult> encodingResults(std::span<const EncodedSession> sessions);

struct PersonEncodings {
    std::string name;
    std::vector<EncodingResult> encodings;  ///< in the order of first use
};

/// One person's difference of two encodings.
struct PersonDifference {
    std::string name;
    Estimate accuracy;   ///< Newcombe 95 %
    double bits = kNaN;  ///< difference of the corrected information
    bool aFirst = false;
};

struct PairOverPeople {
    std::string a, b;                      ///< the differences are a minus b
    std::vector<PersonDifference> people;  ///< those who had both
    Estimate accuracy;                     ///< mean over people; without an interval for one person
    Estimate bits;                         ///< the same of the corrected information
    std::size_t aBetter = 0, bBetter = 0;  ///< number of people with more right answers
    double exchangeP = kNaN;               ///< two-sided, exact; NaN for more than kMaxExchanged people
};
inline constexpr std::size_t kMaxExchanged = 16;

struct EncodingsOverPeople {
    std::vector<PersonEncodings> people;
    std::vector<PairOverPeople> pairs;  ///< only pairs that at least one person had
    std::string better;                 ///< better than every other by the intervals; empty: not decided
    std::string who = "people";
};

/// Mean over people with the interval above. `variances`: of each value, from its trials. `among`: number of intervals
/// that are judged together. The ends are NaN for one value; all are NaN for none.
[[nodiscard]] Estimate meanOverPeople(std::span<const double> values, std::span<const double> variances,
                                      std::size_t among = 1);

[[nodiscard]] EncodingsOverPeople compareEncodingsOver(std::vector<PersonEncodings> people);

/// Returns for each pair whether one of them is better, by how much, for how many people, and what the figures assume;
/// empty without a pair.
[[nodiscard]] std::vector<std::string> encodingSentences(const EncodingsOverPeople& found);

/// Returns how a profile takes the better encoding; empty if none is, or if it is not one of a study.
[[nodiscard]] std::string assignmentSentence(const EncodingsOverPeople& found);

/// The results of a study's participants of one kind: each session in a row, and the encodings over people.
struct StudyFigures {
    std::vector<SessionFigures> sessions;
    EncodingsOverPeople encodings;
    bool massager = false;  ///< levels are strengths
};

}  // namespace tacto
