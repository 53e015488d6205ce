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

}  // namespace
}  // namespace tacto::test
