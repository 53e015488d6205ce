// Tests the profile editor: refuses values in the core's words, applies valid ones, keeps files.
#include <QComboBox>
#include <QFile>
#include <QPushButton>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "app/gui/live/ProfileEditor.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/live/LiveBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::ProfileEditor;
using gui::ProfileField;
using testing::HasSubstr;

class Editor : public LiveBench {
protected:
    Editor() {
        editor.setAttribute(Qt::WA_DeleteOnClose, false);
        editor.show();
    }
    /// Replaces the text of a field by typing.
    void type(const char* key, const QString& text) {
        auto* line = editor.findChild<QLineEdit*>(key);
        ASSERT_NE(line, nullptr) << key;
        line->selectAll();
        QTest::keyClick(line, Qt::Key_Delete);
        QTest::keyClicks(line, text);
    }
    QPushButton& button(const QString& text) {
        auto* found = find<QPushButton>(editor, text);
        EXPECT_NE(found, nullptr) << text.toStdString();
        return *found;
    }
    QString says() { return editor.findChild<QLabel*>("profileTrouble")->text(); }
    QString refusal(const char* key) { return editor.findChild<QLabel*>(QString("trouble-%1").arg(key))->text(); }
    void showTab(int index) { editor.findChild<QTabWidget*>()->setCurrentIndex(index); }

    ProfileEditor editor{controller};
};

TEST_F(Editor, RefusesAWrongValueInTheSentenceOfTheCoreWithTheNamesOfItsFields) {
    type("amplitude_min_v", "45");
    auto wrong = controller.profile().encoding;
    wrong.amplitudeMin = Volts(45);
    const auto sentence = validate(wrong).error().message;
    EXPECT_THAT(editor.trouble().toStdString(), HasSubstr(sentence));
    const auto* words = "“Smallest amplitude” 45 V is not below “Largest amplitude” 40 V.";
    EXPECT_EQ(refusal("amplitude_min_v").toStdString(), std::string("⚠ ") + words) << "beside the field";
    EXPECT_EQ(says().toStdString(), std::string("⚠ Cannot be applied: ") + words) << "on every tab";
    EXPECT_TRUE(editor.findChild<QLabel*>("trouble-amplitude_min_v")->isVisible());
    EXPECT_FALSE(button("Apply").isEnabled());
    EXPECT_FALSE(button("Save…").isEnabled());
    EXPECT_EQ(editor.findChild<QLineEdit*>("amplitude_min_v")->text(), "45") << "never clamped";
    click(button("Apply"));
    EXPECT_EQ(controller.profile().encoding.amplitudeMin.value(), 10);
    type("amplitude_min_v", "12.5");
    EXPECT_TRUE(editor.trouble().isEmpty());
    EXPECT_FALSE(editor.findChild<QLabel*>("trouble-amplitude_min_v")->isVisible());
    EXPECT_TRUE(button("Apply").isEnabled());
}

TEST_F(Editor, RefusesWhatIsNoNumber) {
    for (const auto* text : {"", "abc", "1,500", "nan", "inf", "10 V"}) {
        type("amplitude_min_v", text);
        EXPECT_THAT(refusal("amplitude_min_v").toStdString(), HasSubstr("is not a number")) << text;
        EXPECT_FALSE(button("Apply").isEnabled()) << text;
    }
    showTab(1);
    type("pulses", "1.5");
    type("amplitude_min_v", "10");
    EXPECT_THAT(refusal("pulses").toStdString(), HasSubstr("a whole number from 1 to 1000"));
}

TEST_F(Editor, AppliesARightValueToAnOpenBench) {
    ASSERT_IN_TIME(openSimulated());
    EXPECT_THAT(says().toStdString(), HasSubstr("In force."));
    EXPECT_FALSE(button("Apply").isEnabled()) << "nothing has changed";
    type("amplitude_max_v", "30");
    EXPECT_THAT(says().toStdString(), HasSubstr("not applied yet"));
    click(button("Apply"));
    ASSERT_IN_TIME(comesTrue([this] { return controller.profile().encoding.amplitudeMax.value() == 30; }));
    EXPECT_IN_TIME(comesTrue([this] { return says().contains("In force."); }));
    ASSERT_IN_TIME(armed());
    controller.drive(DriveSource::Manual, 1, 1);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().amplitude_v == 30; }))
        << controller.telemetry().amplitude_v;
    shot(editor, "profile_light");
}

TEST_F(Editor, SaysWhyItWasNotAppliedWhileArmed) {
    ASSERT_IN_TIME(openSimulated() && armed());
    type("amplitude_max_v", "30");
    click(button("Apply"));
    ASSERT_IN_TIME(comesTrue([this] { return says().contains("Not applied"); }));
    EXPECT_THAT(says().toStdString(), HasSubstr("disarm first"));
    EXPECT_EQ(controller.profile().encoding.amplitudeMax.value(), 40);
    EXPECT_TRUE(button("Apply").isEnabled()) << "it can be tried again";
}

TEST_F(Editor, EveryFieldIsAcceptedAsShippedAndRefusedOutsideItsRange) {
    for (const auto& field : gui::profileForm()) {
        showTab(static_cast<int>(field.tab));
        if (field.isChoice()) {
            EXPECT_GE(editor.findChild<QComboBox*>(field.key)->currentIndex(), 0) << field.key;
            EXPECT_EQ(field.words.size(), field.stored->words.size()) << field.key;
            EXPECT_EQ(editor.findChild<QComboBox*>(field.key)->count(), int(field.stored->words.size())) << field.key;
            continue;
        }
        auto* line = editor.findChild<QLineEdit*>(field.key);
        ASSERT_NE(line, nullptr) << field.key;
        EXPECT_FALSE(field.range().isEmpty()) << field.key;
        const auto shipped = line->text();
        const auto& accepted = field.stored->numbers.value();
        std::vector<double> outside{accepted.low - 1};
        if (accepted.openLow) outside.push_back(accepted.low);
        if (accepted.high < 1e12) outside.push_back(accepted.openHigh ? accepted.high : accepted.high * 1.01);
        for (const double value : outside) {
            line->setText(QString::number(value, 'g', 17));
            EXPECT_FALSE(editor.trouble().isEmpty()) << field.key << " took " << value;
        }
        line->setText(shipped);
        ASSERT_TRUE(editor.trouble().isEmpty()) << field.key << ": " << editor.trouble().toStdString();
    }
}

TEST_F(Editor, ARefusalStandsBesideTheFieldThatItNames) {
    const std::pair<const char*, const char*> wrong[] = {
        {"interval_min_s", "3"},      {"phase_width_us", "0"},      {"rate_hz", "0"},
        {"inter_phase_gap_us", "-1"}, {"smoothing_s", "0"},         {"band_low_hz", "2"},
        {"load_low_ohm", "20000"},    {"electrode_area_cm2", "-3"}, {"interval_ratio_per_train", "0.5"}};
    for (const auto& [key, value] : wrong) {
        auto* line = editor.findChild<QLineEdit*>(key);
        const auto shipped = line->text();
        line->setText(value);
        EXPECT_FALSE(refusal(key).isEmpty()) << key << ": " << editor.trouble().toStdString();
        line->setText(shipped);
    }
}

TEST_F(Editor, OnlyWhatMattersCanBeEdited) {
    auto* beta = editor.findChild<QLineEdit*>("amplitude_beta");
    EXPECT_FALSE(beta->isEnabled());
    auto* curve = editor.findChild<QComboBox*>("amplitude_curve");
    curve->setFocus();
    QTest::keyClick(curve, Qt::Key_End);  // selects "power"
    EXPECT_TRUE(beta->isEnabled());
    showTab(1);
    auto* shape = editor.findChild<QComboBox*>("shape");
    QTest::keyClick(shape, Qt::Key_End);  // selects "monophasic"
    EXPECT_FALSE(editor.findChild<QLineEdit*>("inter_phase_gap_us")->isEnabled());
}

TEST_F(Editor, TellsChargeAndImbalanceOfThePulse) {
    const auto facts = [this] { return editor.findChild<QLabel*>("profileFacts")->text().toStdString(); };
    EXPECT_THAT(facts(), HasSubstr("500"));
    EXPECT_THAT(facts(), HasSubstr("16.0")) << "40 V × 200 µs into 500 Ω, in µC";
    EXPECT_THAT(facts(), HasSubstr("imbalance 0"));
    showTab(1);
    type("phase_width_us", "100");
    EXPECT_THAT(facts(), HasSubstr("8.00"));
    QTest::keyClick(editor.findChild<QComboBox*>("shape"), Qt::Key_End);
    EXPECT_THAT(facts(), HasSubstr("imbalance 100"));
}

TEST_F(Editor, MarksWhereTouchStandsOnTheCurves) {
    ASSERT_IN_TIME(openSimulated() && armed());
    controller.drive(DriveSource::Manual, 0.5, 1);
    auto* preview = editor.findChild<gui::ProfilePreview*>();
    ASSERT_IN_TIME(comesTrue([&] {
        return preview->marked() && std::abs(preview->marked()->x() - 25) < 0.01 &&
               std::abs(preview->marked()->y() - 0.5) < 0.01;
    }));
}

TEST_F(Editor, KeepsAProfileInAFile) {
    const QTemporaryDir folder;
    const auto path = folder.filePath("mine.json");
    auto* name = editor.findChild<QLineEdit*>();
    for (auto* line : editor.findChildren<QLineEdit*>()) {
        if (line->text() == "default") name = line;
    }
    name->setText("my profile");
    type("interval_max_s", "1.3333333333333333");
    editor.saveFile(path);
    EXPECT_THAT(says().toStdString(), HasSubstr("Saved to"));
    const auto kept = loadProfile(path.toStdString());
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(kept->name, "my profile");
    EXPECT_EQ(kept->encoding.intervalMax.count(), 1.3333333333333333) << "to the last digit";
    click(button("Shipped values"));
    EXPECT_EQ(editor.findChild<QLineEdit*>("interval_max_s")->text(), "2");
    editor.openFile(path);
    EXPECT_EQ(editor.findChild<QLineEdit*>("interval_max_s")->text(), "1.3333333333333333");
    EXPECT_EQ(controller.profile().encoding.intervalMax.count(), 2) << "only Apply applies";
}

TEST_F(Editor, ANamedElectrodeIsPartOfTheProfile) {
    const QTemporaryDir folder;
    const auto kept = [&] {
        const auto path = folder.filePath("mine.json");
        editor.saveFile(path);
        const auto profile = loadProfile(path.toStdString());
        return profile ? profile->electrode : ElectrodeDescription{profile.error().message, {}, {}};
    };
    auto& name = *editor.findChild<QComboBox*>("electrode")->lineEdit();
    EXPECT_FALSE(kept());
    QTest::keyClicks(&name, "TENS 40");
    EXPECT_FALSE(kept()) << "no area is of this name";
    type("electrode_area_cm2", "4");
    EXPECT_EQ(kept(), (ElectrodeDescription{"TENS 40", {}, {}}));
    type("electrode_material", "Ag/AgCl");
    type("electrode_medium", "hydrogel");
    const auto whole = kept();
    EXPECT_EQ(whole, (ElectrodeDescription{"TENS 40", "Ag/AgCl", "hydrogel"}));
    click(button("Shipped values"));
    EXPECT_FALSE(kept());
    editor.openFile(folder.filePath("mine.json"));  // written without one meanwhile
    EXPECT_FALSE(kept());
    const auto mine = folder.filePath("named.json");
    Profile named;
    named.electrodeArea = SquareCentimetres(4);
    named.electrode = whole;
    std::ofstream(mine.toStdString()) << toJson(named).dump();
    editor.openFile(mine);
    EXPECT_EQ(name.text(), "TENS 40");
    EXPECT_EQ(kept(), whole);
    showTab(3);
    shot(editor, "profile-electrode");
    EXPECT_EQ(faultsOf(editor), "");
}

TEST_F(Editor, AFileThatIsWrongIsRefusedAndTheFormStays) {
    const QTemporaryDir folder;
    const auto path = folder.filePath("wrong.json");
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(R"({"encoding": {"amplitude_max_v": 4000}})");
    file.close();
    type("interval_max_s", "1.5");
    editor.openFile(path);
    EXPECT_THAT(says().toStdString(),
                HasSubstr("\"amplitude_max_v\" is 4000 V; a number from 0.01 to 500 V was expected"));
    EXPECT_EQ(editor.findChild<QLineEdit*>("interval_max_s")->text(), "1.5");
    editor.openFile(folder.filePath("nothing.json"));
    EXPECT_THAT(says().toStdString(), HasSubstr("Not opened"));
    editor.saveFile(folder.filePath("no/such/folder.json"));
    EXPECT_THAT(says().toStdString(), HasSubstr("was not written"));
}

TEST_F(Editor, LooksRightInBothThemes) {
    const auto looks = [this](const char* name) {
        ASSERT_IN_TIME(passes(0.2));
        shot(editor, name);
        EXPECT_EQ(faultsOf(editor), "") << name;
    };
    ASSERT_IN_TIME(openSimulated());
    type("amplitude_min_v", "45");
    looks("profile_wrong");
    type("amplitude_min_v", "10");
    gui::applyTheme(gui::Theme::Dark);
    showTab(1);
    looks("profile_dark");
    showTab(2);
    looks("profile_touch");
}

}  // namespace
}  // namespace tacto::test
