// Kills a program that changes a study at random moments: acknowledged changes stay, and the next program can open the
// study.
#include <random>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/study/StudyVerify.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

class StudyCrash : public test::StudyDesk {
protected:
    /// Enrols, takes consents and withdraws every third participant until killed; reports each acknowledged change.
    [[noreturn]] void changeForEver(int pipe) const {
        auto study = open();
        if (!study) ::_exit(1);
        const auto say = [&](char what) {
            if (::write(pipe, &what, 1) != 1) ::_exit(2);
        };
        for (std::uint64_t seed = 1;; ++seed) {
            Participant participant;
            participant.virtualSeed = seed;
            const auto made = study->enrol(participant);
            if (!made) ::_exit(3);
            say('e');
            if (!study->consent(made->code, {"2", study->today(), "KL"})) ::_exit(4);
            say('c');
            if (seed % 3 != 0) continue;
            if (!study->withdraw(made->code)) ::_exit(5);
            say('w');
        }
    }
};

TEST_F(StudyCrash, Kill9AtAnyMomentLosesNothingThatWasAcknowledged) {
    RecordProperty("hazard", "H8");
    auto settings = test::someStudy();
    settings.participantsMax = 10'000;
    for (int round = 0; round < 8; ++round) {
        std::filesystem::remove_all(folder());
        static_cast<void>(make(settings));
        std::mt19937 random(static_cast<unsigned>(round));
        const auto lines = 1 + random() % 25;
        SCOPED_TRACE(fmt::format("killed after {} acknowledgements", lines));
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            ::close(ends[0]);
            changeForEver(ends[1]);
        }
        ::close(ends[1]);
        std::size_t enrolledSaid = 0, consentsSaid = 0, withdrawnSaid = 0, said = 0;
        char what = 0;
        while (::read(ends[0], &what, 1) == 1) {
            if (++said == lines) {
                ASSERT_EQ(::kill(child, SIGKILL), 0);
            }
            enrolledSaid += what == 'e';
            consentsSaid += what == 'c';
            withdrawnSaid += what == 'w';
        }
        ::close(ends[0]);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself with " << WEXITSTATUS(status);
        const auto verified = test::accepted(verifyStudy(folder()));
        EXPECT_EQ(testing::PrintToString(verified.problems), "{}");
        auto study = test::accepted(open());
        std::size_t withdrawn = 0, consents = 0;
        for (const auto& participant : study.participants()) {
            withdrawn += participant.state == ParticipantState::Withdrawn;
            consents += participant.consents.size();
            EXPECT_EQ(participant.code.empty(), participant.state == ParticipantState::Withdrawn);
        }
        EXPECT_GE(study.participants().size(), enrolledSaid);
        EXPECT_LE(study.participants().size(), enrolledSaid + 1);
        EXPECT_GE(withdrawn, withdrawnSaid);
        EXPECT_GE(consents + withdrawn, consentsSaid);
        Participant next;
        next.virtualSeed = 1'000'000;
        EXPECT_TRUE(study.enrol(next));
    }
}

}  // namespace
}  // namespace tacto
