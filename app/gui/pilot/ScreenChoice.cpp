#include "app/gui/pilot/ScreenChoice.h"

#include <QGuiApplication>
#include <QScreen>
#include <QSettings>

namespace tacto::gui {

namespace {
constexpr const char* kScreenKey = "pilot/screen";
}

ScreenChoice::ScreenChoice(QWidget* parent) : QComboBox(parent) {
    setObjectName("participantScreen");
    setAccessibleName(tr("The participant’s screen"));
    setToolTip(tr("Where the participant’s window opens, full screen. Remembered by name."));
    fill();
    connect(this, &QComboBox::activated, this, [this] { QSettings().setValue(kScreenKey, chosenName()); });
    connect(qGuiApp, &QGuiApplication::screenAdded, this, [this](const QScreen* screen) {
        const bool wanted = screen->name() == chosenName();
        fill();
        if (wanted) emit back(screen->name());
    });
    connect(qGuiApp, &QGuiApplication::screenRemoved, this, [this](const QScreen* screen) {
        const auto name = screen->name();
        if (name == chosenName()) emit lost(name);
        if (name != chosenName()) fill();
    });
}

/// The remembered one; else one that is not the operator's; else the only one.
void ScreenChoice::fill() {
    const auto before = currentIndex() >= 0 ? chosenName() : QSettings().value(kScreenKey).toString();
    clear();
    for (const auto* screen : QGuiApplication::screens()) {
        const auto size = screen->geometry().size();
        addItem(tr("%1, %2 × %3").arg(screen->name()).arg(size.width()).arg(size.height()), screen->name());
    }
    int index = findData(before);
    if (index < 0) {
        index = 0;
        for (int i = 0; i < count(); ++i) {
            if (itemData(i).toString() != QGuiApplication::primaryScreen()->name()) index = i;
        }
    }
    setCurrentIndex(index);
}

QScreen* ScreenChoice::chosen() const {
    for (auto* screen : QGuiApplication::screens()) {
        if (screen->name() == chosenName()) return screen;
    }
    return nullptr;
}

QScreen* ScreenChoice::seat() {
    if (chosen() == nullptr) fill();
    return chosen();
}

bool ScreenChoice::isOnly() { return QGuiApplication::screens().size() < 2; }

}  // namespace tacto::gui

#include "moc_ScreenChoice.cpp"
