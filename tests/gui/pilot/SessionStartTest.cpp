// Tests the steps before a session of a study: a checklist without defaults, and an interrupted session.
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <QTest>
#include <fstream>
#include <gmock/gmock.h>

#include "app/gui/controller/DeviceWatch.h"
#include "app/gui/pilot/RehearsalPage.h"
#include "app/gui/pilot/SessionStartPage.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/PluggedButtons.h"
#include "tests/gui/pilot/PluggedDevices.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class SessionStart : public testing::Test {
protected:
    /// Prepares a rehearsal, whose keys need no passphrase.
    void prepare(std::optional<std::uint64_t> virtualSeed, Modality modality = Modality::Electrodes) {
        StudySettings settings;
        settings.modality = modality;
        study = Study::createRehearsal(scratch.path() / "study", settings).value();
        Participant enrolled;
        enrolled.virtualSeed = virtualSeed;
        who = study->enrol(enrolled).value();
        ASSERT_TRUE(study->consent(who.code, {study->settings().consentVersion, study->today(), "KL"}));
        who = study->participants().front();
        page.resize(1000, 640);
        EXPECT_EQ(page.prepare(*study, who), "");
        page.show();
        ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&page));
    }
    void answer(const char* word) {
        for (const auto& item : exclusionItems())
            page.findChild<QRadioButton*>(QString::fromStdString(std::string(item.key)) + word)->click();
    }
    void plug(std::vector<DeviceIdentity> devices) {
        plugs->set(std::move(devices));
        watch.look();
        ASSERT_IN_TIME(comesTrue([this] { return watch.devices() == plugs->all(); }));
    }
    [[nodiscard]] std::vector<std::string> devices() const {
        std::vector<std::string> uris;
        for (const auto& uri : page.start().devices) uris.push_back(uri.text());
        return uris;
    }
    [[nodiscard]] QComboBox& box(const char* name) { return *page.findChild<QComboBox*>(name); }
    [[nodiscard]] QPushButton& begin() { return *page.findChild<QPushButton*>("beginSession"); }

    ScratchDir scratch;
    std::optional<Study> study;
    Participant who;
    std::shared_ptr<Plugs> plugs = std::make_shared<Plugs>();
    gui::DeviceWatch watch{[plugs = plugs] {
                               std::vector<std::unique_ptr<Driver>> drivers;
                               drivers.push_back(std::make_unique<PluggedDevices>(plugs));
                               return Registry(std::move(drivers));
                           },
                           std::chrono::seconds(1)};
    gui::SessionStartPage page{watch};
};

TEST_F(SessionStart, EveryQuestionIsAnsweredAndNoneBeforehand) {
    RecordProperty("hazard", "H12");
    prepare({});
    const auto* checklist = page.findChild<gui::ExclusionChecklist*>();
    EXPECT_TRUE(checklist->answers().empty());
    EXPECT_FALSE(begin().isEnabled());
    const auto* whyNot = page.findChild<QLabel*>("whyNotBegin");
    EXPECT_EQ(whyNot->text(), begin().toolTip()) << "in sight, not under the mouse alone";
    EXPECT_TRUE(page.start().exclusions.empty());
    answer("-no");
    EXPECT_TRUE(begin().isEnabled());
    EXPECT_TRUE(whyNot->text().isEmpty());
    const auto all = page.start().exclusions;
    ASSERT_EQ(all.size(), exclusionItems().size());
    EXPECT_TRUE(exclusionGate(all));
    page.findChild<QRadioButton*>("epilepsy-yes")->click();
    const auto yes = exclusionGate(page.start().exclusions);
    ASSERT_FALSE(yes) << "the study's gate says what a yes means; the page hides none";
    EXPECT_EQ(yes.error().code, kGateRefused);
    EXPECT_FALSE(begin().isEnabled());
    EXPECT_TRUE(whyNot->text().contains("yes"));
    EXPECT_EQ(page.prepare(*study, who), "");
    EXPECT_TRUE(checklist->answers().empty()) << "each session asks anew";
    EXPECT_TRUE(page.start().confirmsCode) << "on their own screen";
}

TEST_F(SessionStart, AYesChangedToNoStaysOneUntilItIsTickedAsASlip) {
    RecordProperty("hazard", "H12");
    prepare({});
    int begins = 0, ends = 0;
    QObject::connect(&page, &gui::SessionStartPage::beginWanted, &page, [&] { ++begins; });
    QObject::connect(&page, &gui::SessionStartPage::endDayWanted, &page, [&] { ++ends; });
    auto* endDay = page.findChild<QPushButton*>("endDay");
    auto* slip = page.findChild<QCheckBox*>("yesWasASlip");
    answer("-no");
    EXPECT_FALSE(endDay->isVisible());
    EXPECT_FALSE(slip->isVisible()) << "no yes was given";
    const auto click = [this](const char* name) { page.findChild<QRadioButton*>(name)->click(); };
    for (int round = 0; round < 2; ++round) {
        SCOPED_TRACE(round == 0 ? "first" : "again: a tick is about an earlier yes");
        click("epilepsy-yes");
        EXPECT_FALSE(begin().isVisible());
        ASSERT_TRUE(endDay->isVisible() && endDay->isEnabled()) << "whatever else is missing";
        const auto says = page.findChild<QLabel*>("whyNotBegin")->text().toStdString();
        EXPECT_THAT(says, testing::Not(HasSubstr("keeps the answer"))) << "it is not kept yet";
        click("epilepsy-no");
        EXPECT_FALSE(begin().isEnabled());
        EXPECT_FALSE(exclusionGate(page.start().exclusions)) << "the yes stands";
        ASSERT_TRUE(slip->isVisible());
        if (round == 0) looksRight(page, "session-start-slip", {QSize(1160, 640), QSize(1160, 900)});
        slip->click();
        EXPECT_TRUE(begin().isVisible() && begin().isEnabled()) << "corrected deliberately";
        EXPECT_TRUE(exclusionGate(page.start().exclusions));
    }
    click("heart-yes");
    test::click(*endDay);
    EXPECT_EQ(ends, 1);
    EXPECT_EQ(begins, 0);
    EXPECT_EQ(page.prepare(*study, who), "");
    EXPECT_FALSE(slip->isVisible());
    EXPECT_FALSE(endDay->isVisible());
}

TEST_F(SessionStart, TheLaboratorysOwnQuestionsStandBelowTheOthers) {
    RecordProperty("hazard", "H12");
    prepare({});
    auto* checklist = page.findChild<gui::ExclusionChecklist*>();
    StudySettings settings;
    settings.exclusions = {"Are you cold?", "Do you wear a watch?"};
    checklist->ask(exclusionItems(settings));
    answer("-no");
    EXPECT_FALSE(checklist->whole()) << "two more are asked";
    auto* cold = page.findChild<QRadioButton*>("own-1-no");
    EXPECT_EQ(page.findChild<QRadioButton*>("hf-yes")->nextInFocusChain(), cold) << "Tab goes on to them";
    for (const char* own : {"own-1-no", "own-2-yes"}) page.findChild<QRadioButton*>(own)->click();
    EXPECT_TRUE(checklist->whole());
    EXPECT_EQ(exclusionGate(checklist->answers(), settings).error().code, kGateRefused);
    settings.exclusions = {"Do you wear a watch?"};
    checklist->ask(exclusionItems(settings));
    EXPECT_TRUE(checklist->answers().empty());
    EXPECT_EQ(checklist->items().back().question, "Do you wear a watch?");
    checklist->ask(exclusionItems());
    EXPECT_EQ(page.findChild<QRadioButton*>("own-1-no"), nullptr);
}

TEST_F(SessionStart, AVirtualParticipantHasNoChecklistAndNoScreen) {
    prepare(7);
    EXPECT_FALSE(page.findChild<gui::ExclusionChecklist*>()->isVisible());
    EXPECT_TRUE(begin().isEnabled());
    EXPECT_FALSE(page.start().person);
    EXPECT_EQ(page.start().participant, who.code);
}

TEST_F(SessionStart, ASessionThatWasBrokenOffIsOfferedWithItsTimeAndAnswers) {
    RecordProperty("hazard", "H8");
    prepare(7);
    auto* offer = page.findChild<gui::UnfinishedOffer*>();
    EXPECT_FALSE(offer->isVisible());
    const auto at = QDateTime::currentDateTime().addSecs(-600);
    offer->offer(gui::Unfinished{2, "pilot-thresholds", 27, at, true});
    const auto says = page.findChild<QLabel*>("unfinishedSays")->text().toStdString();
    EXPECT_THAT(says, HasSubstr("Session 2 was interrupted"));
    EXPECT_THAT(says, HasSubstr(at.toString("HH:mm").toStdString()));
    EXPECT_THAT(says, HasSubstr("after 27 answers"));
    EXPECT_FALSE(begin().isEnabled()) << "neither is chosen beforehand";
    page.findChild<QRadioButton*>("goOnWithIt")->click();
    EXPECT_TRUE(begin().isEnabled());
    EXPECT_EQ(page.start().unfinished, "resume");
    EXPECT_EQ(page.start().protocol, "pilot-thresholds") << "the one it was of";
    page.findChild<QRadioButton*>("endIt")->click();
    EXPECT_EQ(page.start().unfinished, "end");
    offer->offer(gui::Unfinished{2, "pilot-thresholds", 27, at.addSecs(-7200), false});
    EXPECT_FALSE(page.findChild<QRadioButton*>("goOnWithIt")->isEnabled()) << "too long ago";
    EXPECT_EQ(page.start().unfinished, "");
}

TEST_F(SessionStart, OneWhoseRecordIsNotWholeIsOfferedToBeEndedAlone) {
    RecordProperty("hazard", "H8");
    prepare(7);
    SessionRequest request;
    request.code = who.code;
    request.script = {"pilot-thresholds", "a"};
    request.codeConfirmed = request.devicesSimulated = true;
    request.exclusions = nothingExcludes();
    const auto begun = study->beginSession(request);
    ASSERT_TRUE(begun) << begun.error().message;
    std::ofstream(begun->path) << "no session";
    EXPECT_EQ(page.prepare(*study, who), "");
    EXPECT_TRUE(page.findChild<gui::UnfinishedOffer*>()->asks());
    const auto says = page.findChild<QLabel*>("unfinishedSays")->text().toStdString();
    EXPECT_THAT(says, HasSubstr("Session 1 was interrupted"));
    EXPECT_THAT(says, HasSubstr(begun->path.filename().string())) << "why it cannot be gone on with";
    EXPECT_FALSE(page.findChild<QRadioButton*>("goOnWithIt")->isEnabled());
    page.findChild<QRadioButton*>("endIt")->click();
    EXPECT_EQ(page.start().unfinished, "end");
}

TEST_F(SessionStart, ARehearsalThatWasInterruptedIsOfferedWhateverItsSeed) {
    RecordProperty("hazard", "H8");
    prepare(7);
    SessionRequest request;
    request.code = who.code;
    request.script = {"pilot-thresholds", "a"};
    request.codeConfirmed = request.devicesSimulated = true;
    request.exclusions = nothingExcludes();
    ASSERT_TRUE(study->beginSession(request));
    const auto place = QString::fromStdString((scratch.path() / "study").string());
    QSettings().setValue("lastRehearsal", place);
    const gui::RehearsalPage next;
    EXPECT_EQ(next.folder(), place);
    EXPECT_EQ(next.rehearsal().seed, 7U);
    EXPECT_TRUE(next.findChild<gui::UnfinishedOffer*>()->asks());
    QSettings().remove("lastRehearsal");
}

TEST_F(SessionStart, AVirtualParticipantAndARehearsalWithElectrodesHaveTheSimulatedBenchAlone) {
    RecordProperty("hazard", "H11");
    ASSERT_NO_FATAL_FAILURE(plug({PluggedDevices::massager("M1")}));
    prepare({});
    EXPECT_EQ(box("deliversWith").count(), 1);
    EXPECT_THAT(devices(), testing::ElementsAre("sim:"));
    EXPECT_FALSE(box("looksAtMotor").isVisible());
    EXPECT_TRUE(page.start().simulated());
}

TEST_F(SessionStart, AMassagerIsChosenAndNoneTakesThePlaceOfOneThatIsGone) {
    RecordProperty("hazard", "H11");
    auto blocked = PluggedDevices::massager("M3");
    blocked.obstacle = "Another program uses it.";
    const auto one = PluggedDevices::massager("M1"), two = PluggedDevices::massager("M2");
    ASSERT_NO_FATAL_FAILURE(plug({one, two, blocked, PluggedDevices::board("TSB-1")}));
    prepare({}, Modality::Massager);
    answer("-no");
    EXPECT_THAT(devices(), testing::ElementsAre("sim:")) << "of a rehearsal, until a device is chosen";
    auto& delivers = box("deliversWith");
    ASSERT_EQ(delivers.count(), 4);
    EXPECT_FALSE(delivers.model()->flags(delivers.model()->index(3, 0)).testFlag(Qt::ItemIsEnabled));
    EXPECT_EQ(delivers.itemData(3, Qt::ToolTipRole).toString(), "Another program uses it.");
    delivers.setCurrentIndex(2);
    EXPECT_THAT(devices(), testing::ElementsAre("plugged:M2"));
    EXPECT_FALSE(page.start().simulated());
    EXPECT_TRUE(page.start().massager);
    auto& looks = box("looksAtMotor");
    EXPECT_TRUE(looks.isVisible());
    looks.setCurrentIndex(1);
    EXPECT_THAT(devices(), testing::ElementsAre("plugged:M2", "plugged:TSB-1"));
    EXPECT_TRUE(begin().isEnabled());

    ASSERT_NO_FATAL_FAILURE(plug({one}));
    EXPECT_THAT(devices(), testing::IsEmpty());
    EXPECT_FALSE(begin().isEnabled());
    EXPECT_EQ(begin().toolTip(), "Choose the device that delivers.");
    ASSERT_NO_FATAL_FAILURE(plug({one, two}));
    EXPECT_THAT(devices(), testing::IsEmpty()) << "it is chosen anew";
    delivers.setCurrentIndex(1);
    EXPECT_EQ(begin().toolTip(), "The sensor board on the motor is gone. Choose another, or nothing.");
    looks.setCurrentIndex(0);
    EXPECT_THAT(devices(), testing::ElementsAre("plugged:M1"));
}

TEST_F(SessionStart, MarkersAreOffUntilAPortIsGivenAndAWrongOneIsInTheWay) {
    RecordProperty("hazard", "H11");
    prepare(std::nullopt, Modality::Massager);
    auto* markers = page.findChild<QLineEdit*>("markers");
    ASSERT_NE(markers, nullptr);
    EXPECT_EQ(markers->text(), "off");
    EXPECT_FALSE(page.start().markers);
    markers->setText("80");
    EXPECT_FALSE(begin().isEnabled());
    EXPECT_THAT(begin().toolTip().toStdString(), HasSubstr("1024 to 65535"));
    EXPECT_FALSE(page.start().markers);
    markers->setText("5005");
    EXPECT_THAT(begin().toolTip().toStdString(), testing::Not(HasSubstr("65535")));
    EXPECT_EQ(page.start().markers, (MarkerAddress{"127.0.0.1", 5005}));
    emit markers->editingFinished();
    const gui::SessionStartPage next{watch};
    EXPECT_EQ(next.findChild<QLineEdit*>("markers")->text(), "5005") << "it is remembered, and shown";
    markers->setText("");
    emit markers->editingFinished();
    EXPECT_FALSE(page.start().markers);
    EXPECT_FALSE(page.start().lsl.wanted());
    markers->setText("LSL");
    EXPECT_EQ(page.start().lsl, (LslOrder{true, ""}));
    EXPECT_FALSE(page.start().markers);
    markers->setText("5006 lsl");
    EXPECT_EQ(page.start().lsl, (LslOrder{true, ""}));
    EXPECT_EQ(page.start().markers, (MarkerAddress{"127.0.0.1", 5006}));
    markers->setText("80 lsl");
    EXPECT_FALSE(begin().isEnabled());
}

TEST_F(SessionStart, LooksRightInBothThemesAndSizes) {
    prepare({});
    page.findChild<gui::UnfinishedOffer*>()->offer(
        gui::Unfinished{1, "pilot-identification", 113, QDateTime::currentDateTime().addSecs(-600), true});
    answer("-no");
    const auto buttons = std::make_shared<PluggedButtons>();
    buttons->set({PluggedButtons::pad("Logitech Dual Action"), PluggedButtons::pad("VEC USB Footpedal", 3)});
    page.setButtonDevices(buttons);
    const char* pad = "inputOf Logitech Dual Action";
    ASSERT_IN_TIME(comesTrue([&] { return page.findChild<QComboBox*>(pad) != nullptr; }));
    emit box(pad).activated(1);
    buttons->press("Logitech Dual Action", 6);
    page.say("P-7K3D has given no consent; a dated consent to version 2 is needed.");
    looksRight(page, "session-start", {QSize(1160, 640), QSize(1160, 900)});
}

TEST_F(SessionStart, TabGoesThroughItInTheOrderOfReading) {
    prepare({});
    answer("-no");
    page.activateWindow();
    ASSERT_IN_TIME(comesTrue([this] { return page.isActiveWindow(); }));
    std::vector<const QWidget*> order;
    for (auto* at = static_cast<QWidget*>(&begin()); order.empty() || at != &begin();
         at = QApplication::focusWidget()) {
        ASSERT_NE(at, nullptr);
        ASSERT_LT(order.size(), 100U) << "Tab does not come round";
        at->setFocus(Qt::TabFocusReason);
        order.push_back(at);
        QTest::keyClick(at, Qt::Key_Tab);
    }
    // The page's first control, which Tab reaches after the last one.
    const QWidget* first = &page;
    do first = first->nextInFocusChain();
    while (std::ranges::find(order, first) == order.end());
    std::ranges::rotate(order, std::ranges::find(order, first));
    EXPECT_EQ(stepsBack(order), "");
    for (const auto* control : page.findChildren<QWidget*>()) {
        const bool works = qobject_cast<const QAbstractButton*>(control) || qobject_cast<const QComboBox*>(control);
        if (!works || !control->isVisible() || !control->isEnabled() || (control->focusPolicy() & Qt::TabFocus) == 0 ||
            (qobject_cast<const QRadioButton*>(control) && !qobject_cast<const QRadioButton*>(control)->isChecked()))
            continue;
        EXPECT_TRUE(std::ranges::find(order, control) != order.end()) << widgetName(*control);
    }
}

}  // namespace
}  // namespace tacto::test
