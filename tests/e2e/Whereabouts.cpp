// Whereabouts.cpp - a Qt plugin for end-to-end tests of the built program (QT_QPA_GENERIC_PLUGINS). It tells where a
// widget is, so that a click finds it in any layout, and which text it shows. It does not click or type.
//
// A question is the file "ask" in the folder given to the plugin, the answer is the file "answer":
//   where NAME   "X Y", the centre, in real pixels, of the visible and enabled widget with this text, name or
//                accessible name, or of a window with this title; for "tab NAME" of the current tab of a tab bar. If
//                several match, one that no other window covers
//   text NAME    the text of a widget; for a container the text of its visible labels and buttons, from top to bottom,
//                joined by " | "
//   popup        "X Y" of the open menu or list
//   focus        the name of the widget with the focus
// The answer is empty if nothing matches.
#include <QAbstractButton>
#include <QApplication>
#include <QFile>
#include <QGenericPlugin>
#include <QLabel>
#include <QTabBar>
#include <QTimer>
#include <algorithm>
#include <tuple>
#include <vector>

namespace tacto::test {
namespace {

constexpr int kLooksEvery_ms = 20;

bool isCalled(const QWidget& widget, const QString& name) {
    if (widget.objectName() == name || widget.accessibleName() == name) return true;
    if (widget.isWindow() && widget.windowTitle() == name) return true;
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget))
        return QString(button->text()).remove('&') == name;
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) return label->text() == name;
    const auto* tabs = qobject_cast<const QTabBar*>(&widget);
    return tabs != nullptr && name == "tab " + tabs->tabText(tabs->currentIndex()).remove('&');
}

QString middleOf(const QWidget& widget) {
    const auto at = widget.mapToGlobal(widget.rect().center()) * widget.devicePixelRatioF();
    return QString("%1 %2").arg(at.x()).arg(at.y());
}

bool liesOnTop(const QWidget& widget) {
    return QApplication::topLevelAt(widget.mapToGlobal(widget.rect().center())) == widget.window();
}

QString textOf(const QWidget& widget) {
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) return label->text();
    const auto* button = qobject_cast<const QAbstractButton*>(&widget);
    return button == nullptr ? QString() : QString(button->text()).remove('&');
}

QString writtenIn(const QWidget& widget) {
    if (const auto own = textOf(widget); !own.isEmpty()) return own;
    std::vector<std::tuple<int, int, QString>> all;
    for (const auto* inside : widget.findChildren<QWidget*>()) {
        const auto at = inside->mapTo(&widget, QPoint());
        if (const auto text = textOf(*inside); inside->isVisible() && !text.isEmpty())
            all.emplace_back(at.y(), at.x(), text);
    }
    std::ranges::sort(all);
    QStringList texts;
    for (const auto& [y, x, text] : all) texts << text;
    return texts.join(" | ");
}

QString answerTo(const QString& question) {
    if (question == "popup") {
        const auto* popup = QApplication::activePopupWidget();
        return popup == nullptr ? QString() : middleOf(*popup);
    }
    if (question == "focus") {
        const auto* focus = QApplication::focusWidget();
        return focus == nullptr ? QString() : focus->objectName();
    }
    const bool asksText = question.startsWith("text ");
    const auto name = question.section(' ', 1);
    const QWidget* found = nullptr;
    for (const auto* widget : QApplication::allWidgets()) {
        if (!widget->isVisible() || !widget->isEnabled() || !isCalled(*widget, name)) continue;
        if (asksText) return writtenIn(*widget).simplified();
        if (!widget->visibleRegion().contains(widget->rect().center())) continue;
        found = widget;
        if (liesOnTop(*widget)) break;
    }
    return found == nullptr ? QString() : middleOf(*found);
}

class Whereabouts final : public QObject {
public:
    explicit Whereabouts(QString folder) : folder_(std::move(folder)) {
        connect(&looks_, &QTimer::timeout, this, [this] { look(); });
        looks_.start(kLooksEvery_ms);
    }

private:
    void look() {
        QFile ask(folder_ + "/ask");
        if (!ask.open(QIODevice::ReadOnly)) return;
        const auto question = QString::fromUtf8(ask.readAll()).trimmed();
        ask.close();
        ask.remove();
        QFile answer(folder_ + "/answer.new");
        if (!answer.open(QIODevice::WriteOnly)) return;
        answer.write(answerTo(question).toUtf8() + "\n");
        answer.close();
        answer.rename(folder_ + "/answer");
    }
    const QString folder_;
    QTimer looks_;
};

}  // namespace

class WhereaboutsPlugin final : public QGenericPlugin {
    Q_OBJECT
    Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "Whereabouts.json")
public:
    QObject* create(const QString& /*name*/, const QString& folder) override { return new Whereabouts(folder); }
};

}  // namespace tacto::test

#include "Whereabouts.moc"
