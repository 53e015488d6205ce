// Tests that the form of a new study follows the core's table, and that a study can be made from it.
#include <QScrollArea>
#include <set>

#include "app/gui/study/StudyForm.h"
#include "app/gui/study/StudyPage.h"
#include "app/gui/theme/FieldForm.h"
#include "tests/gui/study/OpenedStudy.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// Fields of the core's table that the program fills in.
const std::vector<std::string> kOfTheProgram{"id",
                                             "kind",
                                             "approval.protocol_sha256",
                                             "limits",
                                             "conditions",
                                             "train.shape",
                                             "scripts",
                                             "words",
                                             "procedure.interval_min_s",
                                             "procedure.interval_max_s",
                                             "procedure.conditions_sha256"};

TEST(StudyForm, HasEveryFieldOfTheCoreOnceAndNoOther) {
    std::multiset<std::string> described;
    for (const auto& field : gui::studyForm()) described.emplace(field.key);
    described.insert(kOfTheProgram.begin(), kOfTheProgram.end());
    std::multiset<std::string> stored;
    for (const auto& info : studyFields().infos()) {
        const bool list = info.key == "limits" || info.key == "scripts" || info.key == "words";
        if (info.members.empty() || list) stored.insert(info.key);
        for (const auto& member : info.members) {
            if (!list) stored.insert(info.key + "." + member.key);
        }
    }
    EXPECT_EQ(described, stored);
    const auto all = studyFields().kind().info;
    for (const auto& field : gui::studyForm()) {
        if (field.words.empty()) continue;
        const std::string_view key = field.key;
        const auto dot = key.find('.');
        const auto* info = all.find(key.substr(0, dot));
        if (info != nullptr && dot != std::string::npos) info = info->find(key.substr(dot + 1));
        ASSERT_NE(info, nullptr) << key;
        EXPECT_EQ(field.words.size(), info->words.size()) << key;
    }
}

TEST(StudyForm, LeftAsItIsItHoldsTheDefaults) {
    RecordProperty("hazard", "H12");
    gui::StudyForm form;
    form.show();
    const auto missing = form.read(shippedProfile().value());
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("Title"));
    form.set("title", "Four conditions");
    form.set("approval.reference", "EC-1");
    form.set("approval.from", "2026-11-01");
    form.set("approval.expires", "2027-10-31");
    form.set("consent_version", "2");
    auto read = form.read(shippedProfile().value());
    ASSERT_TRUE(read) << read.error().message;
    StudySettings expected;
    expected.title = "Four conditions";
    expected.approval.reference = "EC-1";
    expected.approval.from = std::chrono::year(2026) / 11 / 1;
    expected.approval.expires = std::chrono::year(2027) / 10 / 31;
    expected.consentVersion = "2";
    expected.painCeiling = kPainCeiling;
    expected.ageMin = kAgeMin;
    expected.limits = read->limits;
    expected.scripts = read->scripts;
    expected.words = read->words;
    expected.procedure = procedureOf(shippedProfile().value(), expected, {});
    EXPECT_EQ(*read, expected);
    EXPECT_FALSE(read->limits.empty());
    EXPECT_FALSE(read->scripts.empty());
    EXPECT_GE(read->words.size(), 2U);
    EXPECT_EQ(read->procedure->intervalMin_s, 0.5);
    EXPECT_EQ(read->procedure->intervalMax_s, 2);
    form.set("procedure.method", "staircase");
    form.set("encodings", "standard,swapped");
    form.set("site", "forearm");
    form.set("electrode.area_cm2", "5.5");
    read = form.read(shippedProfile().value());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->encodings, (std::vector<std::string>{"standard", "swapped"}));
    EXPECT_EQ(read->site, ElectrodeSite::Forearm);
    EXPECT_EQ(read->procedure->method, DetectionMethod::Staircase);
    EXPECT_DOUBLE_EQ(read->electrode.area.value(), 5.5);
    form.set("cap_ma", "16");
    EXPECT_FALSE(form.read(shippedProfile().value())) << "the table's range";
    form.set("cap_ma", "15");
    form.set("approval.expires", "2026-10-31");
    EXPECT_FALSE(form.read(shippedProfile().value())) << "the table's rule: it expires before it begins";
}

TEST_F(StudyInThePage, ANewStudyIsMade) {
    RecordProperty("hazard", "H11");
    const auto leads = [this](const char* name) {
        return page.findChild<QPushButton*>(name)->property("role").toString() == "primary";
    };
    EXPECT_TRUE(leads("newStudyWanted") && !leads("openStudy")) << "there is none to open yet";
    press("newStudyWanted");
    auto* made = page.findChild<gui::NewStudyPage*>();
    ASSERT_TRUE(made->isVisible());
    made->findChild<QLineEdit*>("newStudyFolder")->setText(folder());
    press("createStudy");
    EXPECT_THAT(made->findChild<QLabel*>("newStudyTrouble")->text().toStdString(), HasSubstr("Title"));
    EXPECT_EQ(dialog("passphraseDialog"), nullptr);
    auto* form = made->findChild<gui::StudyForm*>();
    for (const auto& [key, text] : {std::pair("title", "Four conditions"),
                                    {"approval.reference", "EC-2026-17"},
                                    {"approval.from", "2020-01-01"},
                                    {"approval.expires", "2090-12-31"},
                                    {"consent_version", "2"}})
        form->set(key, text);
    auto* create = made->findChild<QPushButton*>("createStudy");
    const auto* trouble = made->findChild<QLabel*>("newStudyTrouble");
    EXPECT_TRUE(create->isEnabled());
    form->set("gap_min_h", "-1");
    EXPECT_FALSE(create->isEnabled());
    for (const char* part : {"Between two sessions at least", "-1", "0 to 10000"})
        EXPECT_THAT(trouble->text().remove(QChar(0x202f)).toStdString(), HasSubstr(part));
    form->set("gap_min_h", "20,5");
    EXPECT_TRUE(create->isEnabled()) << trouble->text().toStdString();
    made->findChild<QLineEdit*>("newStudyFolder")->clear();
    EXPECT_FALSE(create->isEnabled());
    EXPECT_THAT(trouble->text().toStdString(), HasSubstr("folder"));
    made->findChild<QLineEdit*>("newStudyFolder")->setText(folder());
    looksRight(page, "study-new", {QSize(1100, 640), QSize(1160, 640)});
    for (const auto* group : form->findChildren<gui::FieldForm*>()) {
        int below = 1000;
        for (const auto* title : form->findChildren<QLabel*>(QString(), Qt::FindDirectChildrenOnly))
            if (title->x() == group->x() && title->geometry().bottom() < group->y())
                below = std::min(below, group->y() - title->geometry().bottom());
        EXPECT_LE(below, 16) << "a group's title stands at its fields";
    }
    press("createStudy");
    auto* asks = dialog("passphraseDialog");
    ASSERT_NE(asks, nullptr);
    auto* go = asks->findChild<QPushButton*>("usePassphrase");
    QTest::keyClicks(asks->findChild<QLineEdit*>("passphrase"), kWords);
    EXPECT_FALSE(go->isEnabled()) << "a slip would seal it forever";
    QTest::keyClicks(asks->findChild<QLineEdit*>("passphraseAgain"), "correct horse 4712");
    EXPECT_FALSE(go->isEnabled());
    QTest::keyClick(asks->findChild<QLineEdit*>("passphraseAgain"), Qt::Key_Backspace);
    QTest::keyClicks(asks->findChild<QLineEdit*>("passphraseAgain"), "1");
    looksRight(*asks, "passphrase-new", {QSize(), QSize(1000, 680)});
    ASSERT_TRUE(go->isEnabled());
    click(*go);
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
    EXPECT_EQ(study.study()->settings().title, "Four conditions");
    EXPECT_EQ(study.study()->settings().gapMin_h, 20.5);
    EXPECT_TRUE(study.study()->stillApproved());
    EXPECT_TRUE(page.list().isVisible());
}

}  // namespace
}  // namespace tacto::test
