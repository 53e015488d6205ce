#include "app/gui/window/SmallStop.h"

#include <QGuiApplication>
#include <QScreen>
#include <QVBoxLayout>

#include "app/gui/theme/Theme.h"
#include "app/gui/window/StopButton.h"

namespace tacto::gui {

SmallStop::SmallStop(std::function<void()> stop, const QWidget& beside)
    : QWidget(nullptr, Qt::Tool | Qt::CustomizeWindowHint | Qt::WindowTitleHint | Qt::WindowStaysOnTopHint |
                           Qt::WindowDoesNotAcceptFocus),
      stop_(new StopButton(std::move(stop), this)) {
    setObjectName("smallStop");
    setWindowTitle(tr("Tactoscope"));
    setAttribute(Qt::WA_ShowWithoutActivating);
    setAttribute(Qt::WA_QuitOnClose, false);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(stop_);
    showState(InterlockState::Disconnected);
    const auto screen = beside.screen()->availableGeometry();
    constexpr int kMargin = 32;
    resize(sizeHint());
    move(screen.right() - width() - kMargin, screen.bottom() - height() - kMargin);
}

void SmallStop::showState(InterlockState state) { stop_->setHint(stateStyle(state).word); }

bool SmallStop::staysAbove() { return !QGuiApplication::platformName().startsWith("wayland"); }

}  // namespace tacto::gui
