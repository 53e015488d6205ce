// Tests devices as a person writes them: checked while they are typed, or chosen in the dialog that Live has.
#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QSpinBox>
#include <QToolButton>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "app/gui/runner/SimulatedBenchDialog.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/theme/Text.h"
#include "core/electrode/Load.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

TEST(DevicesOf, AllowsBlanksInAFolder) {
    const auto uris = gui::devicesOf(" recording:/data/my finger sim:stimulator?gain=1.1  sim: ").value();
    ASSERT_EQ(uris.size(), 3U);
    EXPECT_EQ(uris[0].text(), "recording:/data/my finger");
    EXPECT_EQ(uris[1].text(), "sim:stimulator?gain=1.1");
    EXPECT_FALSE(gui::devicesOf("nonsense"));
}

class Wiring : public testing::Test {
protected:
    Wiring() {
        panel.checkWith([](const std::vector<DeviceUri>& uris) { return simulatedRegistry().allVirtual(uris); });
        panel.QWidget::show();
    }
    QLineEdit& devices() { return *panel.findChild<QLineEdit*>("devices"); }
    gui::WiringPanel panel;
};

TEST_F(Wiring, AnAddressIsCheckedAsItIsTyped) {
    RecordProperty("hazard", "H4");
    const struct {
        const char* typed;
        const char* says;  ///< what the one sentence must name; empty: it is well
    } all[] = {{"nonsense", "nonsense"},
               {"", ""},
               {"sim:", ""},
               {"sim:stimulator?gain=1.05 sim:", ""},
               {"sim:stimulator?gian=1.05", "gian"},
               {"sim:stimulator?gain=99", "99"},
               {"sim:stimulator?gain=1,05", "1,05"},
               {"sim:stimulator?fault=melts@3s", "melts"},
               {"sim:toaster", "toaster"},
               {"sim:stimulator sim:stimulator", "sim:stimulator"},
               {"smi:stimulator", "smi"},
               {"sim:stimulator?fault=open@12s sim:finger?fault=stale@3s", ""}};
    std::mt19937 random(4910);
    // In any order, because what was typed before must leave nothing behind.
    for (int round = 0; round < 40; ++round) {
        const auto& [typed, says] = all[std::uniform_int_distribution<std::size_t>(0, std::size(all) - 1)(random)];
        devices().setText(typed);
        letLive(220);  // the pause after typing
        const std::string wanted = says;
        EXPECT_IN_TIME(comesTrue([&] {
            const auto refused = panel.refused().toStdString();
            return wanted.empty() ? refused.empty() : refused.find(wanted) != refused.npos;
        })) << typed
            << ": " << panel.refused().toStdString();
        RunOrder order;
        EXPECT_EQ(panel.fill(order).has_value(), wanted.empty()) << typed;
    }
}

TEST_F(Wiring, ARecordingThatIsNotThereIsSaidBeforeTheRun) {
    const ScratchDir folder;
    const auto missing = "recording:" + folder.path().string() + "/none";
    devices().setText(QString::fromStdString(missing));
    EXPECT_IN_TIME(comesTrue([&] { return panel.refused().contains("none"); }));
    devices().setText("sim:");
    EXPECT_IN_TIME(comesTrue([&] { return panel.refused().isEmpty(); }));
}

TEST_F(Wiring, EveryFaultOfTheDialogIsAnAddressThatOpens) {
    RecordProperty("hazard", "H4");
    auto* add = panel.findChild<QToolButton*>();
    ASSERT_NE(add, nullptr);
    int faults = 1;
    for (int fault = 0; fault < faults; ++fault) {
        for (auto* action : add->menu()->actions())
            if (action->text().remove('&').contains("faults")) action->trigger();
        gui::SimulatedBenchDialog* dialog = nullptr;
        ASSERT_IN_TIME(comesTrue([&] { return (dialog = panel.findChild<gui::SimulatedBenchDialog*>()) != nullptr; }));
        auto* kinds = dialog->findChild<QComboBox*>("fault");
        ASSERT_NE(kinds, nullptr);
        faults = kinds->count();
        kinds->setCurrentIndex(fault);
        dialog->findChild<QLineEdit*>("faultAt")->setText("7");
        dialog->findChild<QLineEdit*>("seed")->setText(QString::number(40 + fault));
        auto* use = find<QPushButton>(*dialog, "Use");
        ASSERT_NE(use, nullptr);
        click(*use);
        EXPECT_IN_TIME(comesTrue([&] { return panel.findChild<gui::SimulatedBenchDialog*>() == nullptr; }));
        EXPECT_EQ(devices().text().contains("@7s"), fault > 0) << devices().text().toStdString();
        EXPECT_EQ(panel.findChild<QSpinBox*>("seed")->value(), 40 + fault);
        letLive(400);
        EXPECT_EQ(panel.refused(), "") << devices().text().toStdString();
    }
    EXPECT_GT(faults, 5);
}

TEST_F(Wiring, TheDialogBeginsWithWhatIsThereAndFaultsAreTakenOutAgain) {
    std::mt19937 random(49);
    const auto pick = [&](auto... words) {
        const std::string all[] = {words...};
        return all[std::uniform_int_distribution<std::size_t>(0, sizeof...(words) - 1)(random)];
    };
    for (int round = 0; round < 12; ++round) {
        const auto without = fmt::format("sim:stimulator?mode={}&gain={}&load={}", pick("voltage", "current"),
                                         pick("1", "0.97", "1.25"), pick("500ohm", "1kohm", "200ohm+10kohm||50nF"));
        const auto fault = fmt::format("&fault={}@{}s", pick("open", "short", "drift"), pick("3", "0.5", "120"));
        devices().setText(QString::fromStdString(without + fault + " sim:oscilloscope"));
        EXPECT_EQ(panel.refused(), "");
        for (auto* action : panel.findChild<QToolButton*>()->menu()->actions())
            if (action->text().remove('&').contains("faults")) action->trigger();
        auto* dialog = panel.findChild<gui::SimulatedBenchDialog*>();
        ASSERT_NE(dialog, nullptr);
        click(*find<QPushButton>(*dialog, "Use"));
        ASSERT_IN_TIME(comesTrue([&] { return panel.findChild<gui::SimulatedBenchDialog*>() == nullptr; }));
        const auto told = [this] { return gui::devicesOf(devices().text()).value(); };
        const auto wanted = DeviceUri::parse(without + fault).value(), plain = DeviceUri::parse(without).value();
        const auto loadOf = [](const DeviceUri& uri) { return parseLoad(uri.parameters[2].second).value().text(); };
        ASSERT_EQ(told()[0].parameters.size(), 4U) << devices().text().toStdString();
        EXPECT_EQ(loadOf(told()[0]), loadOf(wanted));
        for (const std::size_t same : {0U, 1U, 3U}) EXPECT_EQ(told()[0].parameters[same], wanted.parameters[same]);
        EXPECT_EQ(devices().cursorPosition(), 0) << "a long address shows its beginning";
        panel.removeFaults();
        EXPECT_FALSE(std::ranges::any_of(told(), gui::simulatesFault));
        EXPECT_EQ(told()[0].parameters.size(), 3U);
        EXPECT_EQ(told()[0].parameters[1], plain.parameters[1]);
    }
}

TEST_F(Wiring, TheDialogOffersOnlyTheDevicesThatTheProtocolNeeds) {
    ProtocolDeclaration declaration;
    declaration.needs = {Role::Stimulator, Role::Oscilloscope};
    panel.show(declaration);
    for (auto* action : panel.findChild<QToolButton*>()->menu()->actions())
        if (action->text().remove('&').contains("faults")) action->trigger();
    auto* dialog = panel.findChild<gui::SimulatedBenchDialog*>();
    ASSERT_NE(dialog, nullptr);
    const auto* faults = dialog->findChild<QComboBox*>("fault");
    for (int i = 0; i < faults->count(); ++i) EXPECT_FALSE(faults->itemText(i).contains("fingertip"));
    EXPECT_GT(faults->count(), 5);
    click(*find<QPushButton>(*dialog, "Use"));
    EXPECT_FALSE(devices().text().contains("finger")) << devices().text().toStdString();
}

}  // namespace
}  // namespace tacto::test
