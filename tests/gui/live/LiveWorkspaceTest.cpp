#include "tests/gui/live/LiveBench.h"

#include <QComboBox>
#include <QPushButton>
#include <QRadioButton>

#include "app/gui/live/ProfileEditor.h"
#include "app/gui/look/Look.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

TEST_F(LiveBench, Looks) {
    shot(live, "empty");
    ASSERT_TRUE(openSimulated());
    auto* surface = live.findChild<QComboBox*>("surface");
    if (surface == nullptr) surface = live.findChildren<QComboBox*>().at(0);
    desk.present("P120", 50, 1);
    ASSERT_TRUE(armed());
    desk.drive(DriveSource::Sensor);
    ASSERT_TRUE(passes(7));
    desk.present("plastic", 50, 0.5);
    ASSERT_TRUE(passes(3));
    shot(live, "sim_light");
    live.resize(860, 520);
    ASSERT_TRUE(passes(1));
    shot(live, "sim_small");
    gui::applyTheme(gui::Theme::Dark);
    live.resize(1500, 950);
    ASSERT_TRUE(passes(1));
    shot(live, "sim_dark");
    gui::ProfileEditor editor(desk);
    editor.setAttribute(Qt::WA_DeleteOnClose, false);
    editor.show();
    ASSERT_TRUE(passes(0.3));
    shot(editor, "profile_dark");
    gui::applyTheme(gui::Theme::Light);
    ASSERT_TRUE(passes(0.3));
    shot(editor, "profile_light");
}

}  // namespace
}  // namespace tacto::test
