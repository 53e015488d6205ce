// Tests a study in the window as a person uses it: enrol, consent, leave, withdraw, report, export.
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>

#include "app/gui/theme/ConfirmButton.h"
#include "core/base/Random.h"
#include "tests/gui/Person.h"
#include "tests/gui/study/OpenedStudy.h"
#include "tests/study/StudySupport.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const LookedAtSizes kDialog{QSize(), QSize(1000, 680)};

std::string said(const QDialog& asks, const char* label) {
    return asks.findChild<QLabel*>(label)->text().toStdString();
}

class StudyPageTest : public StudyInThePage {
protected:
    void SetUp() override {
        make();
        open();
    }
    /// Enrols a participant and returns the code that the dialog shows.
    QString enrol(bool isVirtual, int seed = 1) {
        press("enrol");
        auto* asks = dialog("enrolDialog");
        if (asks == nullptr) return {};
        asks->findChild<QComboBox*>("enrolWho")->setCurrentIndex(isVirtual ? 1 : 0);
        asks->findChild<QLineEdit*>("enrolSeed")->setText(QString::number(seed));
        click(*asks->findChild<QPushButton*>("enrolNow"));
        const auto code = asks->findChild<QLabel*>("enrolledCode")->text();
        looksRight(*asks, "study-enrolled", kDialog);
        asks->close();
        return code;
    }
    void consent(const QString& by) {
        press("consentOne");
        auto* asks = dialog("consentDialog");
        ASSERT_NE(asks, nullptr);
        asks->findChild<QLineEdit*>("by")->setText(by);
        looksRight(*asks, "study-consent", kDialog);
        click(*asks->findChild<QPushButton*>("noteConsent"));
    }
    void pressWhenHeard(QPushButton& button) {
        ASSERT_IN_TIME(comesTrue([&] { return static_cast<gui::ConfirmButton&>(button).listens(); }));
        click(button);
    }
};

TEST_F(StudyPageTest, EnrolsConsentsAndSaysHowEachStands) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    EXPECT_TRUE(checkedCode(code.toStdString())) << code.toStdString();
    ASSERT_EQ(page.findChild<QTableWidget*>("participants")->rowCount(), 1);
    EXPECT_EQ(cell("participants", 0, 0), code.toStdString());
    EXPECT_EQ(cell("participants", 0, 3), "takes part");
    EXPECT_EQ(cell("participants", 0, 5), "none yet");
    consent("");
    auto* asks = dialog("consentDialog");
    ASSERT_NE(asks, nullptr) << "without initials it is refused in place";
    EXPECT_THAT(asks->findChild<QLabel*>("consentTrouble")->text().toStdString(), HasSubstr("initials"));
    asks->close();
    letLive(20);
    consent("KL");
    EXPECT_THAT(cell("participants", 0, 5), HasSubstr("version 2, 20"));
    enrol(true, 7);
    EXPECT_EQ(cell("participants", 1, 1), "virtual, seed 7");
    EXPECT_THAT(page.findChild<QLabel*>("studyFacts")->text().toStdString(), HasSubstr("2 of 5 participants"));
    looksRight(page, "study-list", {QSize(1100, 560), QSize(1160, 640)});
    const auto* people = page.findChild<QTableWidget*>("participants");
    EXPECT_GE(people->columnWidth(0), people->fontMetrics().horizontalAdvance(code) + 8) << "a whole code";
}

TEST_F(StudyPageTest, EnrollingLeadsToTheConsentOfThatParticipantAndEnrolsOnce) {
    RecordProperty("hazard", "H11");
    enrol(true);
    letLive(20);
    press("enrol");
    auto* asks = dialog("enrolDialog");
    ASSERT_NE(asks, nullptr);
    auto* act = asks->findChild<QPushButton*>("enrolNow");
    click(*act);
    const auto code = asks->findChild<QLabel*>("enrolledCode")->text();
    EXPECT_EQ(act->text(), "Note the consent…");
    click(*act);
    auto* consents = dialog("consentDialog");
    ASSERT_NE(consents, nullptr);
    EXPECT_EQ(consents->windowTitle(), "Consent of " + code);
    EXPECT_EQ(consents->focusWidget()->objectName(), "by") << "the other fields are filled in";
    EXPECT_EQ(study.study()->participants().size(), 2U);
    consents->findChild<QLineEdit*>("by")->setText("KL");
    QTest::keyClick(consents->findChild<QLineEdit*>("by"), Qt::Key_Return);
    auto* people = page.findChild<QTableWidget*>("participants");
    ASSERT_EQ(people->rowCount(), 2);
    EXPECT_THAT(cell("participants", 1, 5), HasSubstr("version 2, 20"));
    EXPECT_EQ(people->selectionModel()->selectedRows().front().row(), 1) << "the next step is with them";
}

TEST_F(StudyPageTest, TheStudysOwnButtonsStayInSightHoweverManyArePartOfIt) {
    for (int i = 1; i <= 4; ++i) enrol(true, i);
    page.resize(1000, 420);
    letLive(50);
    for (const char* name : {"studyResultsWanted", "noteOfStudy", "reports", "exportStudy", "closeStudy"}) {
        const auto* button = page.findChild<QPushButton*>(name);
        EXPECT_EQ(button->visibleRegion().boundingRect(), button->rect()) << name;
    }
    shot(page, "study-small");
}

TEST_F(StudyPageTest, AButtonKeepsTheFocusWhileTheListIsReadAgain) {
    enrol(true);
    page.activateWindow();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&page));
    for (const char* name : {"startSession", "consentOne", "exportStudy"}) {
        auto* button = page.findChild<QPushButton*>(name);
        button->setFocus();
        study.noteChange();
        EXPECT_TRUE(button->hasFocus()) << name;
        study.lend();
        EXPECT_FALSE(button->isEnabled()) << name;
        study.takeBack();
        ASSERT_IN_TIME(comesTrue([&] { return !study.busy(); }));
        ASSERT_IN_TIME(comesTrue([&] { return button->isEnabled(); }));
        EXPECT_EQ(page.window()->focusWidget(), button) << name;
    }
}

TEST_F(StudyPageTest, WhatWasOpenLastIsOfferedAgainWhileItIsThere) {
    study.close();
    auto* again = page.findChild<QPushButton*>("recentStudy");
    ASSERT_NE(again, nullptr);
    EXPECT_THAT(again->text().toStdString(), HasSubstr("Four conditions"));
    EXPECT_EQ(page.findChild<QPushButton*>("openStudy")->property("role").toString(), "primary");
    EXPECT_EQ(page.findChild<QPushButton*>("newStudyWanted")->property("role").toString(), "");
    shot(page, "recent-study");
    click(*again);
    ASSERT_IN_TIME(comesTrue([this] { return dialog("passphraseDialog") != nullptr; }));
    dialog("passphraseDialog")->reject();
    std::filesystem::rename(scratch.path() / "study", scratch.path() / "moved");
    const gui::StudyPage later(study);
    EXPECT_EQ(later.findChild<QPushButton*>("recentStudy"), nullptr);
}

TEST_F(StudyPageTest, LeavingKeepsTheDataAndEndsThePart) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    choose("leaveOne");
    auto* asks = dialog("leaveDialog");
    ASSERT_NE(asks, nullptr);
    looksRight(*asks, "study-leave", kDialog);
    pressWhenHeard(*asks->findChild<QPushButton*>("endPart"));
    EXPECT_EQ(cell("participants", 0, 3), "has left; data kept");
    EXPECT_EQ(study.study()->find(code.toStdString())->state, ParticipantState::Left);
}

TEST_F(StudyPageTest, WithdrawingTakesTheCodeTypedAndSaysWhatItDoesNotReach) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    const auto place = scratch.path() / "shared";
    study.exportBids(QString::fromStdString(place.string()));
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
    choose("withdrawOne");
    auto* asks = dialog("withdrawDialog");
    ASSERT_NE(asks, nullptr);
    const auto says = [&](const char* name) { return asks->findChild<QLabel*>(name)->text().toStdString(); };
    EXPECT_THAT(says("withdrawCopies"), HasSubstr("copies of the key file, backups, and spare blocks"));
    EXPECT_THAT(says("withdrawExports"), HasSubstr(place.string()));
    auto* end = asks->findChild<QPushButton*>("endPart");
    EXPECT_FALSE(end->isEnabled());
    auto* typed = asks->findChild<QLineEdit*>("withdrawCode");
    QTest::keyClicks(typed, "P-7K3D");
    EXPECT_FALSE(end->isEnabled()) << "another's code";
    typed->clear();
    QTest::keyClicks(typed, code.toLower());
    looksRight(*asks, "study-withdraw", kDialog);
    pressWhenHeard(*end);
    EXPECT_FALSE(study.study()->find(code.toStdString())) << "nothing knows the code any more";
    EXPECT_FALSE(page.findChild<QTableWidget*>("participants")->isVisible());
}

TEST_F(StudyPageTest, AnOlderLedgerIsRefusedAndGoneBackToByItsWordAndThePassphrase) {
    RecordProperty("hazard", "H11");
    namespace fs = std::filesystem;
    const auto at = fs::path(folder().toStdString()), old = scratch.path() / "old";
    EXPECT_FALSE(page.findChild<QAction*>("goBackInStudy")->isVisible());
    study.close();
    fs::copy_file(at / "ledger.tacto", old);
    open();
    enrol(false);
    study.close();
    fs::copy_file(old, at / "ledger.tacto", fs::copy_options::overwrite_existing);
    open();
    EXPECT_THAT(page.findChild<QLabel*>("studyHolds")->text().toStdString(), HasSubstr("tactoscope-cli study go-back"));
    Participant another;
    EXPECT_FALSE(study.study()->enrol(another));
    ASSERT_TRUE(page.findChild<QAction*>("goBackInStudy")->isVisible());
    choose("goBackInStudy");
    auto* asks = dialog("goBackDialog");
    ASSERT_NE(asks, nullptr);
    const auto loss = study.study()->lossOfGoingBack().value();
    EXPECT_THAT(asks->findChild<QLabel*>("goBackLoss")->text().toStdString(), HasSubstr("1 enrolled"));
    auto* back = asks->findChild<QPushButton*>("goBack");
    auto* words = asks->findChild<QLineEdit*>("goBackPassphrase");
    auto* word = asks->findChild<QLineEdit*>("goBackWord");
    QTest::keyClicks(words, "another");
    EXPECT_FALSE(back->isEnabled());
    QTest::keyClicks(word, QString::fromStdString(loss.word()));
    looksRight(*asks, "study-go-back", kDialog);
    pressWhenHeard(*back);
    EXPECT_THAT(asks->findChild<QLabel*>("goBackTrouble")->text().toStdString(), HasSubstr("another than the study"));
    EXPECT_TRUE(study.study()->goingsBack().empty());
    QTest::keyClicks(words, kWords);
    pressWhenHeard(*back);
    EXPECT_EQ(study.study()->goingsBack().size(), 1U);
    EXPECT_TRUE(study.study()->enrol(another));
}

/// A virtual participant's study with one finished session that began some days ago.
class StudyWithASession : public StudyInThePage {
protected:
    using StudyInThePage::StudyInThePage;
    /// Makes the study, opens it in the window and returns the session's id.
    QString withSession(int days) {
        HandTime then;
        then.now =
            std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()) - std::chrono::hours(24 * days);
        auto surroundings = around();
        surroundings.time = &then;
        const auto words = Passphrase::from(kWords).value();
        QString id;
        {
            auto made = Study::create(folder().toStdString(), settings(), words, surroundings).value();
            Participant about;
            about.virtualSeed = 7;
            const auto enrolled = made.enrol(about).value();
            EXPECT_TRUE(made.consent(enrolled.code, {"2", made.today(), "KL"}));
            auto request = someRequest(enrolled.code);
            for (const auto& script : made.settings().scripts) {
                if (script.name == "pilot-identification") request.script = script;
            }
            request.procedure = made.settings().procedure.value();
            const auto begun = made.beginSession(request);
            EXPECT_TRUE(begun) << begun.error().message;
            if (begun) {
                id = QString::fromStdString(begun->session.id);
                EXPECT_TRUE(made.endSession(begun->session.id, StudySessionState::Stopped, ""));
            }
        }
        open();
        return id;
    }
    static void pick(QDialog& asks, const char* box, const QVariant& key) {
        auto* combo = asks.findChild<QComboBox*>(box);
        combo->setCurrentIndex(combo->findData(key));
    }
};

TEST_F(StudyPageTest, AnAmendmentIsNotedWithAReferenceOfItsOwnAndKeepsTheOtherSettings) {
    RecordProperty("hazard", "H11");
    const auto before = study.study()->settings();
    choose("amendStudy");
    auto* asks = dialog("amendDialog");
    ASSERT_NE(asks, nullptr);
    const auto said = [&] { return asks->findChild<QLabel*>("amendTrouble")->text().toStdString(); };
    click(*asks->findChild<QPushButton*>("amendNow"));
    EXPECT_THAT(said(), HasSubstr("Reference of the amendment"));
    asks->findChild<QLineEdit*>("approval.reference")->setText("EC-2026-17");
    asks->findChild<QLineEdit*>("blocks")->setText("4");
    click(*asks->findChild<QPushButton*>("amendNow"));
    EXPECT_THAT(said(), HasSubstr("n amendment needs a reference of its own, not \"EC-2026-17\""));
    EXPECT_EQ(study.study()->settings().blocks, before.blocks);
    looksRight(*asks, "study-amend", kDialog);
    asks->findChild<QLineEdit*>("approval.reference")->setText("EC-2026-17 A1");
    click(*asks->findChild<QPushButton*>("amendNow"));
    ASSERT_EQ(study.study()->amendments().size(), 1U);
    EXPECT_EQ(study.study()->amendments()[0].reference, "EC-2026-17 A1");
    EXPECT_EQ(study.study()->amendments()[0].changed, (std::vector<std::string>{"blocks"}));
    EXPECT_EQ(study.study()->settings().blocks, 4);
    EXPECT_EQ(study.study()->settings().approval.expires, before.approval.expires);
    EXPECT_TRUE(study.study()->stillApproved());
    EXPECT_THAT(page.findChild<QLabel*>("studyFacts")->text().toStdString(), HasSubstr("EC-2026-17 A1"));
}

TEST_F(StudyPageTest, ThePassphraseIsJudgedAndChangedAndThePageSaysWhereTheKeysLie) {
    RecordProperty("hazard", "H11");
    const auto keys = page.findChild<QLabel*>("studyKeys")->text().toStdString();
    EXPECT_THAT(keys, HasSubstr(study.study()->keyFile().string()));
    EXPECT_TRUE(std::filesystem::exists(study.study()->keyFile()));
    looksRight(page, "study-page-empty", {QSize(1100, 640), QSize(1280, 720)});
    choose("changePassphrase");
    auto* asks = dialog("passphraseDialog");
    ASSERT_NE(asks, nullptr);
    auto* go = asks->findChild<QPushButton*>("usePassphrase");
    const auto type = [&](const char* soFar, const char* next) {
        for (const auto& [name, text] :
             {std::pair("passphraseSoFar", soFar), {"passphrase", next}, {"passphraseAgain", next}}) {
            asks->findChild<gui::PassphraseEdit*>(name)->wipe();
            QTest::keyClicks(asks->findChild<QLineEdit*>(name), text);
        }
    };
    EXPECT_FALSE(go->isEnabled());
    EXPECT_THAT(said(*asks, "passphraseTrouble"), HasSubstr("four words")) << "what would do stands there before";
    type(kWords, "summer 2026");
    EXPECT_FALSE(go->isEnabled());
    EXPECT_THAT(said(*asks, "passphraseTrouble"), HasSubstr("at least 40 bits"));
    looksRight(*asks, "passphrase-change", kDialog);
    constexpr const char* kNext = "kettle river 3094 lamp";
    type("another one 4711", kNext);
    ASSERT_TRUE(go->isEnabled());
    click(*go);
    EXPECT_THAT(said(*asks, "passphraseTrouble"), HasSubstr("is another"));
    type(kWords, kNext);
    click(*go);
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr && dialog("passphraseDialog") == nullptr; }));
    EXPECT_THAT(page.findChild<QLabel*>("studyTrouble")->text().toStdString(), HasSubstr("replace them"));
    press("closeStudy");
    for (const auto& [words, opens] : {std::pair(kWords, false), {kNext, true}}) {
        const auto passphrase = Passphrase::from(words).value();
        EXPECT_EQ(Study::open(folder().toStdString(), &passphrase, Study::Access::Read, around()).has_value(), opens);
    }
}

TEST_F(StudyPageTest, EveryKindOfNoteIsMadeInItsDialogAndTheParticularsAreShownAgain) {
    RecordProperty("hazard", "H11");
    for (const auto& kind : studyLogKinds()) {
        SCOPED_TRACE(kind.key);
        choose(qPrintable(QString("note-") + kind.key));
        auto* asks = dialog("noteDialog");
        ASSERT_NE(asks, nullptr);
        click(*asks->findChild<QPushButton*>("noteIt"));
        EXPECT_FALSE(asks->findChild<QLabel*>("noteTrouble")->text().isEmpty()) << "it says nothing yet";
        looksRight(*asks, qPrintable(QString("study-note-") + kind.key), kDialog);
        for (const auto& field : kind.fields) {
            if (auto* box = asks->findChild<QComboBox*>(field.key))
                box->setCurrentIndex(1);
            else
                asks->findChild<QLineEdit*>(field.key)->setText(field.is == StudyLogField::Is::Date ? "2026-11-20"
                                                                                                    : "a text");
        }
        click(*asks->findChild<QPushButton*>("noteIt"));
        ASSERT_EQ(study.study()->notes().back().kind, kind.key);
        EXPECT_EQ(study.study()->notes().back().said.size(), kind.fields.size());
        EXPECT_THAT(page.findChild<QLabel*>("studyTrouble")->text().toStdString(), HasSubstr("Noted")) << "it is said";
        letLive(20);
    }
    choose("note-particulars");
    auto* asks = dialog("noteDialog");
    EXPECT_EQ(asks->findChild<QLineEdit*>("objectives")->text(), "a text");
    EXPECT_EQ(asks->findChild<QComboBox*>("electrode_shape")->currentData().toString(), "circular");
    asks->close();
}

/// Writes drawn texts into the fields of a dialog, right and wrong ones; returns those that are in a line.
QStringList fillAtRandom(QDialog& asks, Random& random) {
    constexpr const char* kTexts[] = {"",           "2",          "KL",  "a text", "34",     "34.5",
                                      "1,000",      "0,5",        "16",  "999999", "-1",     "2020-02-02",
                                      "2090-01-01", "2026-13-40", "nan", "P-7K3D", "unknown"};
    QStringList typed;
    for (auto* box : asks.findChildren<QComboBox*>()) {
        const bool open = box->currentData().toString().isEmpty() && box->count() > 1;
        if (box->isVisible() && random.below(4) < (open ? 3 : 1))
            box->setCurrentIndex(
                int(open ? 1 + random.below(std::size_t(box->count()) - 1) : random.below(std::size_t(box->count()))));
    }
    const auto lines = asks.findChildren<QLineEdit*>();
    const double share = std::min(0.5, 2.0 / double(lines.size()));  // a long form is refused soon enough
    for (auto* line : lines) {
        if (!line->isVisible() || line->isReadOnly()) continue;
        if (line->objectName() == "approval.reference" && random.below(4) > 0)
            line->setText(QString("A%1").arg(random.below(100000)));
        else if (line->objectName() == "what" && random.below(4) > 0)
            line->setText("a text");
        else if (random.uniform() < share)
            line->setText(kTexts[random.below(std::size(kTexts))]);
        typed << line->text();
    }
    return typed;
}

TEST_F(StudyPageTest, WhatTheStudyWouldRefuseDisablesTheButtonWithTheReasonAndNothingElseDoes) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    letLive(20);
    Random random(49, "what is typed in a study's dialogs");
    struct Opens {
        const char *name, *button;
        std::function<void()> by;
    };
    std::vector<Opens> all{{"enrolDialog", "enrolNow", [&] { press("enrol"); }},
                           {"consentDialog", "noteConsent", [&] { press("consentOne"); }},
                           {"adverseEventDialog", "noteEvent", [&] { choose("noteAdverseEvent"); }},
                           {"amendDialog", "amendNow", [&] { choose("amendStudy"); }}};
    for (const auto& kind : studyLogKinds())
        all.push_back({"noteDialog", "noteIt", [&, key = kind.key] { choose(qPrintable(QString("note-") + key)); }});
    std::map<std::string, std::pair<int, int>> counts;  // taken, refused
    for (int round = 0; round < 72; ++round) {
        const auto& [name, button, by] = all[std::size_t(round) % all.size()];
        by();
        auto* asks = dialog(name);
        ASSERT_NE(asks, nullptr) << name;
        const auto typed = fillAtRandom(*asks, random);
        auto* act = asks->findChild<QPushButton*>(button);
        const auto* trouble = asks->findChild<QLabel*>(QString(name).replace("Dialog", "Trouble"));
        const auto before = study.study()->ledgerHead();
        auto& [taken, refused] = counts[name];
        if (!act->isEnabled()) {
            ++refused;
            EXPECT_TRUE(trouble->isVisible()) << name;
            const auto why = trouble->text();
            const bool names =
                why.contains(u'“') || why.contains(u'"') || why.contains("note says nothing") || why.contains("own") ||
                why.contains("are enrolled") ||
                std::ranges::any_of(typed, [&](const QString& each) { return !each.isEmpty() && why.contains(each); });
            EXPECT_TRUE(names) << name << ": " << why.toStdString();
            click(*act);
            EXPECT_EQ(study.study()->ledgerHead(), before) << why.toStdString();
        } else {
            ++taken;
            click(*act);
            EXPECT_NE(study.study()->ledgerHead(), before) << name << ": " << trouble->text().toStdString();
        }
        if (asks->isVisible()) asks->close();
        letLive(5);
        page.findChild<QTableWidget*>("participants")->selectRow(0);
    }
    for (const auto& [name, seen] : counts) {
        EXPECT_GT(seen.first, 0) << name;
        EXPECT_GT(seen.second, 0) << name;
    }
    EXPECT_TRUE(study.study()->find(code.toStdString()));
}

TEST_F(StudyPageTest, ADecimalCommaIsReadAndAValueOutOfRangeIsNamedWithItsRange) {
    RecordProperty("hazard", "H12");
    choose("amendStudy");
    auto* asks = dialog("amendDialog");
    ASSERT_NE(asks, nullptr);
    asks->findChild<QLineEdit*>("approval.reference")->setText("A1");
    auto* act = asks->findChild<QPushButton*>("amendNow");
    EXPECT_TRUE(act->isEnabled());
    asks->findChild<QLineEdit*>("cap_ma")->setText("15,5");
    EXPECT_FALSE(act->isEnabled());
    for (const char* part : {"Current at most", "15.5", "15 mA"})
        EXPECT_THAT(said(*asks, "amendTrouble"), HasSubstr(part));
    looksRight(*asks, "study-amend-refused", kDialog);
    asks->findChild<QLineEdit*>("cap_ma")->setText("14,5");
    asks->findChild<QLineEdit*>("electrode.area_cm2")->setText("5,5");
    ASSERT_TRUE(act->isEnabled()) << said(*asks, "amendTrouble");
    click(*act);
    EXPECT_EQ(study.study()->settings().cap_mA, 14.5);
    EXPECT_EQ(study.study()->settings().electrode.area.value(), 5.5);
}

TEST_F(StudyPageTest, AfterASeriousEventTheStudyIsReleasedByNameInTheWindow) {
    RecordProperty("hazard", "H12");
    auto* release = page.findChild<QAction*>("releaseStudy");
    EXPECT_FALSE(release->isVisible());
    ASSERT_TRUE(study.study()->adverseEvent({}, {.what = "fell", .serious = true}));
    study.noteChange();
    EXPECT_TRUE(release->isVisible());
    EXPECT_THAT(page.findChild<QLabel*>("studyHolds")->text().toStdString(), HasSubstr("dverse event 1 was serious"));
    choose("releaseStudy");
    auto* asks = dialog("releaseDialog");
    ASSERT_NE(asks, nullptr);
    click(*asks->findChild<QPushButton*>("releaseNow"));
    EXPECT_THAT(said(*asks, "releaseTrouble"), HasSubstr("Released by"));
    asks->findChild<QLineEdit*>("by")->setText("K. Lang");
    looksRight(*asks, "study-release", kDialog);
    click(*asks->findChild<QPushButton*>("releaseNow"));
    EXPECT_TRUE(study.study()->stillApproved());
    EXPECT_FALSE(release->isVisible());
}

TEST_F(StudyPageTest, AnExportAsksForAgeAndSexAndSaysInWhichForm) {
    RecordProperty("hazard", "H11");
    choose("exportWithAbout");
    auto* asks = dialog("exportDialog");
    ASSERT_NE(asks, nullptr);
    EXPECT_FALSE(asks->findChild<QCheckBox*>("age")->isChecked()) << "nothing is published unasked";
    asks->findChild<QCheckBox*>("age")->click();
    looksRight(*asks, "study-export", kDialog);
    asks->close();
}

TEST_F(StudyPageTest, AgeSexAndHandednessAreAskedOfPeopleAndMayBeLeftOut) {
    RecordProperty("hazard", "H11");
    press("enrol");
    auto* asks = dialog("enrolDialog");
    ASSERT_NE(asks, nullptr);
    auto* age = asks->findChild<QLineEdit*>("enrolAge");
    EXPECT_TRUE(age->isVisible());
    EXPECT_EQ(age->placeholderText().toStdString(), "not given");
    age->setText("34.5");
    click(*asks->findChild<QPushButton*>("enrolNow"));
    EXPECT_THAT(asks->findChild<QLabel*>("enrolTrouble")->text().toStdString(),
                HasSubstr("ge is \"34.5\"; whole years from 1 to 120 are accepted, or nothing"));
    looksRight(*asks, "study-enrol-refused", kDialog);
    age->setText("34");
    auto* hand = asks->findChild<QComboBox*>("enrolHandedness");
    hand->setCurrentIndex(hand->findData("left"));
    click(*asks->findChild<QPushButton*>("enrolNow"));
    const auto code = asks->findChild<QLabel*>("enrolledCode")->text().toStdString();
    asks->close();
    const auto about = study.study()->find(code);
    ASSERT_TRUE(about) << about.error().message;
    EXPECT_EQ(about->age, "34");
    EXPECT_EQ(about->sex, "");
    EXPECT_EQ(about->handedness, "left");
    letLive(20);
    press("enrol");
    asks = dialog("enrolDialog");
    asks->findChild<QComboBox*>("enrolWho")->setCurrentIndex(1);
    EXPECT_FALSE(asks->findChild<QLineEdit*>("enrolAge")->isVisible()) << "a virtual participant has none";
    asks->close();
}

TEST_F(StudyWithASession, AnAdverseEventIsNotedByTheWindow) {
    RecordProperty("hazard", "H12");
    const auto session = withSession(2);
    choose("noteAdverseEvent");
    auto* asks = dialog("adverseEventDialog");
    ASSERT_NE(asks, nullptr);
    EXPECT_EQ(asks->findChild<QComboBox*>("session")->currentData().toString(), session);
    click(*asks->findChild<QPushButton*>("noteEvent"));
    EXPECT_THAT(said(*asks, "adverseEventTrouble"), HasSubstr("What happened"));
    asks->findChild<QLineEdit*>("what")->setText("burning");
    pick(*asks, "severity", "3");
    click(*asks->findChild<QPushButton*>("noteEvent"));
    EXPECT_THAT(said(*asks, "adverseEventTrouble"), HasSubstr("Relation to the stimulation"));
    EXPECT_EQ(study.study()->adverseEventCount(), 0U);
    looksRight(*asks, "study-adverse-event", kDialog);
    for (const auto& [name, words] : {std::pair("severity", std::span<const char* const>(kEventSeverities)),
                                      std::pair("relation", std::span<const char* const>(kRelations))}) {
        const auto* box = asks->findChild<QComboBox*>(name);
        ASSERT_EQ(box->count(), int(words.size()) + 1) << name;
        for (int i = 1; i < box->count(); ++i)
            EXPECT_EQ(box->itemText(i).toStdString(), fmt::format("{}  {}", i, words[std::size_t(i - 1)]));
    }
    pick(*asks, "relation", "4");
    asks->findChild<QLineEdit*>("action")->setText("cooled");
    click(*asks->findChild<QPushButton*>("noteEvent"));
    const auto events = study.study()->adverseEvents().value();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].first, session.toStdString());
    EXPECT_EQ(events[0].second.what, "burning");
    EXPECT_EQ(events[0].second.severity, 3);
    EXPECT_EQ(events[0].second.relation, 4);
    EXPECT_EQ(events[0].second.action, "cooled");
    EXPECT_FALSE(events[0].second.serious);
}

TEST_F(StudyWithASession, ASeriousEventIsNotedAndTheHoldIsStillSaid) {
    RecordProperty("hazard", "H12");
    withSession(2);
    choose("noteAdverseEvent");
    auto* asks = dialog("adverseEventDialog");
    ASSERT_NE(asks, nullptr);
    asks->findChild<QLineEdit*>("what")->setText("fell");
    pick(*asks, "severity", "3");
    pick(*asks, "relation", "1");
    asks->findChild<QCheckBox*>("serious")->setChecked(true);
    click(*asks->findChild<QPushButton*>("noteEvent"));
    ASSERT_EQ(study.study()->adverseEventCount(), 1U);
    EXPECT_THAT(page.findChild<QLabel*>("studyTrouble")->text().toStdString(), HasSubstr("Noted"));
    const auto* holds = page.findChild<QLabel*>("studyHolds");
    const auto held = holds->text().toStdString();
    for (const char* part : {"⚠", "No session can begin", "Release after a serious event"})
        EXPECT_THAT(held, HasSubstr(part));
    for (auto* action : page.findChild<QPushButton*>("noteOfStudy")->menu()->actions()) {
        const auto name = action->objectName();
        if (!action->isVisible() || !action->isEnabled()) continue;
        action->trigger();
        for (auto* dialog : page.findChildren<QDialog*>()) dialog->reject();
        EXPECT_EQ(holds->text().toStdString(), held) << name.toStdString();
        EXPECT_FALSE(holds->isHidden()) << name.toStdString();
    }
}

TEST_F(StudyWithASession, TheDayAfterIsNotedByTheWindow) {
    RecordProperty("hazard", "H12");
    const auto session = withSession(2);
    choose("noteNextDay");
    auto* asks = dialog("nextDayDialog");
    ASSERT_NE(asks, nullptr);
    click(*asks->findChild<QPushButton*>("noteDay"));
    EXPECT_THAT(said(*asks, "nextDayTrouble"), HasSubstr("Redness of the skin"))
        << "no score stands for an unknown one";
    pick(*asks, "erythema", "1");
    pick(*asks, "oedema", "0");
    pick(*asks, "itching-severity", 2);
    click(*asks->findChild<QPushButton*>("noteDay"));
    EXPECT_THAT(said(*asks, "nextDayTrouble"), HasSubstr("“Itching”"));
    EXPECT_FALSE(study.study()->nextDay(session.toStdString()));
    looksRight(*asks, "study-next-day", kDialog);
    pick(*asks, "itching-relation", 5);
    click(*asks->findChild<QPushButton*>("noteDay"));
    const NextDay expected{.erythema = 1, .oedema = 0, .sideEffects = {{"itching", 2, 5}}};
    EXPECT_EQ(study.study()->nextDay(session.toStdString()), expected);
}

TEST_F(StudyWithASession, AScoreThatNobodyChoseIsRefusedWhileTheStudyIsBusyAndAfterwards) {
    RecordProperty("hazard", "H12");
    const auto session = withSession(2);
    choose("noteNextDay");
    auto* asks = dialog("nextDayDialog");
    ASSERT_NE(asks, nullptr);
    auto* act = asks->findChild<QPushButton*>("noteDay");
    study.lend();
    pick(*asks, "oedema", "0");
    EXPECT_FALSE(act->isEnabled());
    EXPECT_THAT(said(*asks, "nextDayTrouble"), HasSubstr("Redness of the skin"));
    study.takeBack();
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
    EXPECT_FALSE(act->isEnabled());
    act->setEnabled(true);
    click(*act);
    EXPECT_FALSE(study.study()->nextDay(session.toStdString())) << "refused in whatever state the button is";
    study.lend();
    pick(*asks, "erythema", "3");
    pick(*asks, "session", "");
    study.takeBack();
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
    EXPECT_FALSE(act->isEnabled()) << "judged again once the study is there";
    asks->close();
}

TEST_F(StudyWithASession, TheDayAfterIsRefusedOnTheSameDay) {
    RecordProperty("hazard", "H12");
    const auto session = withSession(0);
    choose("noteNextDay");
    auto* asks = dialog("nextDayDialog");
    ASSERT_NE(asks, nullptr);
    pick(*asks, "erythema", "0");
    pick(*asks, "oedema", "0");
    click(*asks->findChild<QPushButton*>("noteDay"));
    EXPECT_THAT(said(*asks, "nextDayTrouble"), HasSubstr("is noted on a later day"));
    EXPECT_FALSE(study.study()->nextDay(session.toStdString()));
    asks->close();
}

class StudyOfThisUser : public StudyWithASession {
protected:
    StudyOfThisUser() : StudyWithASession(false) {}
    /// Lets the command line's program write a report into a file of this name.
    void report(const char* action, const QString& name) {
        if (study.study() == nullptr) {
            ASSERT_NO_FATAL_FAILURE(make());
            ASSERT_NO_FATAL_FAILURE(open());
        }
        choose(action);
        QFileDialog* asks = nullptr;
        ASSERT_IN_TIME(comesTrue([&] {
            asks = page.findChild<QFileDialog*>();
            return asks != nullptr && asks->isVisible();
        }));
        out = QString::fromStdString(scratch.path().string()) + '/' + name;
        emit asks->fileSelected(out);
        asks->close();
        const auto* said = page.findChild<QLabel*>("studyTrouble");
        ASSERT_IN_TIME(comesTrue([&] { return said->text().contains(name) || said->text().startsWith("⚠"); }, 30'000));
        EXPECT_TRUE(QFileInfo::exists(out)) << said->text().toStdString();
    }
    QString out;
};

TEST_F(StudyOfThisUser, GetsAReportFromTheCommandLinesProgram) {
    RecordProperty("hazard", "H8");
    report("committeeReport", "committee.html");
}

TEST_F(StudyOfThisUser, AReportThatNamesPeopleIsNotedWithItsPlaceAndShown) {
    RecordProperty("hazard", "H11");
    ASSERT_NO_FATAL_FAILURE(report("studyReport", "study.pdf"));
    const auto exports = study.study()->exports();
    ASSERT_EQ(exports.size(), 1U);
    EXPECT_EQ(exports[0].what, "study report");
    EXPECT_EQ(exports[0].place, out.toStdString());
    ASSERT_IN_TIME(comesTrue([this] { return dialog("reportWindow") != nullptr; }));
    EXPECT_EQ(dialog("reportWindow")->findChild<QLineEdit*>("signedBy"), nullptr) << "no session keeps a signature yet";
    dialog("reportWindow")->close();
}

TEST_F(StudyOfThisUser, AReportOfSessionsWithoutAClosedRecordIsNotSigned) {
    RecordProperty("hazard", "H11");
    withSession(2);  // ended, but its file was never made
    ASSERT_NO_FATAL_FAILURE(report("committeeReport", "committee.pdf"));
    EXPECT_THAT(page.findChild<QLabel*>("studyTrouble")->text().toStdString(), HasSubstr("no closed session"));
    ASSERT_IN_TIME(comesTrue([this] { return dialog("reportWindow") != nullptr; }));
    EXPECT_EQ(dialog("reportWindow")->findChild<QLineEdit*>("signedBy"), nullptr);
    dialog("reportWindow")->close();
}

TEST_F(StudyPageTest, AnExportInsideTheStudyIsRefused) {
    RecordProperty("hazard", "H11");
    enrol(true);
    study.exportBids(folder() + "/shared");
    const auto* said = page.findChild<QLabel*>("studyTrouble");
    ASSERT_IN_TIME(comesTrue([&] { return said->text().startsWith("⚠"); }));
    EXPECT_THAT(said->text().toStdString(), HasSubstr("inside the study folder"));
    EXPECT_TRUE(study.study()->exports().empty());
}

}  // namespace
}  // namespace tacto::test
