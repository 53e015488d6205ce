#include "app/gui/window/HelpWindow.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QFile>
#include <QGridLayout>
#include <QLabel>
#include <QScrollArea>
#include <QTabWidget>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <QWhatsThis>

#include "app/gui/theme/LimitSetView.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

QString definitions() {
    const auto resources = resourcesFolder();
    if (!resources) return QString::fromStdString(resources.error().message);
    QFile file(QString::fromStdString((*resources / "help" / "definitions.md").string()));
    if (!file.open(QIODevice::ReadOnly)) return QObject::tr("%1 cannot be read.").arg(file.fileName());
    return QString::fromUtf8(file.readAll());
}

QTextBrowser* page(QWidget* parent) {
    auto* browser = new QTextBrowser(parent);
    browser->setOpenExternalLinks(false);
    return browser;
}

struct Key {
    const char* keys;
    const char* does;
};
constexpr const char* kAlways = QT_TRANSLATE_NOOP("Keys", "Always");
constexpr const char* kAboutBench = QT_TRANSLATE_NOOP("Keys", "Bench and protocols");
constexpr const char* kScopeKeys = QT_TRANSLATE_NOOP("Keys", "Oscilloscope and plots");
const std::vector<std::pair<const char*, std::vector<Key>>>& allKeys() {
    static const std::vector<std::pair<const char*, std::vector<Key>>> all{
        {kAlways,
         {{"Esc, Pause", QT_TRANSLATE_NOOP("Keys", "output off, from anywhere")},
          {"Space", QT_TRANSLATE_NOOP("Keys", "output off, outside text fields")},
          {"Return", QT_TRANSLATE_NOOP("Keys", "presses the focused button")},
          {"Ctrl+1 … Ctrl+7", QT_TRANSLATE_NOOP("Keys", "the seven workspaces")},
          {"F1", QT_TRANSLATE_NOOP("Keys", "explains what has the focus")},
          {"?", QT_TRANSLATE_NOOP("Keys", "this sheet")},
          {"Ctrl+D", QT_TRANSLATE_NOOP("Keys", "opens the docks, or collapses them to a strip")},
          {"F11", QT_TRANSLATE_NOOP("Keys", "safety bar and plot alone")},
          {"Shift+F11", QT_TRANSLATE_NOOP("Keys", "full screen")},
          {"Ctrl+Q", QT_TRANSLATE_NOOP("Keys", "output off and quit")}}},
        {kAboutBench,
         {{"Ctrl+B", QT_TRANSLATE_NOOP("Keys", "opens the simulated bench")},
          {"Ctrl+O", QT_TRANSLATE_NOOP("Keys", "opens a recording, session or capture")},
          {"Ctrl+M", QT_TRANSLATE_NOOP("Keys", "marks this moment with a word, in plots, session and report")},
          {"Ctrl+Shift+A", QT_TRANSLATE_NOOP("Keys", "arms: the first of two steps")},
          {"F5", QT_TRANSLATE_NOOP("Keys", "runs the protocol")},
          {"Shift+F5", QT_TRANSLATE_NOOP("Keys", "stops the protocol")}}},
        {kScopeKeys,
         {{"R", QT_TRANSLATE_NOOP("Keys", "runs the oscilloscope, or holds the picture")},
          {"S, N, A", QT_TRANSLATE_NOOP("Keys", "single, normal, auto")},
          {"T, L", QT_TRANSLATE_NOOP("Keys", "cursors across time, across level")},
          {"1, 2, 3, 4", QT_TRANSLATE_NOOP("Keys", "takes hold of a cursor")},
          {"B", QT_TRANSLATE_NOOP("Keys", "draws a box to zoom into")},
          {"D", QT_TRANSLATE_NOOP("Keys", "goes to the drive")},
          {"Ctrl+S", QT_TRANSLATE_NOOP("Keys", "saves the picture")},
          {"Wheel, Ctrl+Wheel", QT_TRANSLATE_NOOP("Keys", "zooms time, level")},
          {"Drag", QT_TRANSLATE_NOOP("Keys", "pans")},
          {"Shift+Drag", QT_TRANSLATE_NOOP("Keys", "zooms into a box")},
          {"Double click, Home", QT_TRANSLATE_NOOP("Keys", "fits to the pulse, once more to the whole record")},
          {"Ctrl+Z", QT_TRANSLATE_NOOP("Keys", "undoes a zoom")},
          {"Arrows", QT_TRANSLATE_NOOP("Keys", "move the focused cursor")}}}};
    return all;
}

void addClose(QDialog& dialog, QVBoxLayout& layout) {
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, &dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::close);
    layout.addWidget(buttons);
}

}  // namespace

QDialog* makeHelpWindow(const ShippedLimits& limits, QWidget* parent) {
    auto* dialog = new QDialog(parent);
    dialog->setWindowTitle(QObject::tr("Definitions and limits"));
    auto* layout = new QVBoxLayout(dialog);
    auto* tabs = new QTabWidget(dialog);
    auto* first = page(tabs);
    first->setMarkdown(definitions());
    tabs->addTab(first, QObject::tr("&Definitions"));
    tabs->addTab(new LimitSetView(limits.sets, tabs), QObject::tr("&Limits"));
    layout->addWidget(tabs);
    addClose(*dialog, *layout);
    const auto metrics = dialog->fontMetrics();
    dialog->resize(metrics.averageCharWidth() * 130, metrics.height() * 34);
    return dialog;
}

QDialog* makeShortcutSheet(QWidget* parent) {
    auto* dialog = new QDialog(parent);
    dialog->setWindowTitle(QObject::tr("Keys"));
    auto* layout = new QVBoxLayout(dialog);
    for (const auto& [topic, keys] : allKeys()) {
        layout->addWidget(heading(QCoreApplication::translate("Keys", topic), dialog));
        auto* grid = new QGridLayout;
        int row = 0;
        for (const auto& key : keys) {
            auto* left = new QLabel(QString("<b>%1</b>").arg(QString(key.keys).toHtmlEscaped()), dialog);
            left->setMinimumWidth(dialog->fontMetrics().horizontalAdvance("Wheel, Ctrl+Wheel") + 24);
            grid->addWidget(left, row, 0);
            grid->addWidget(new QLabel(QCoreApplication::translate("Keys", key.does), dialog), row, 1);
            ++row;
        }
        grid->setColumnStretch(1, 1);
        layout->addLayout(grid);
    }
    addClose(*dialog, *layout);
    return dialog;
}

void explainFocus(QWidget* window) {
    QWidget* widget = QApplication::focusWidget();
    while (widget != nullptr && widget->toolTip().isEmpty() && widget->whatsThis().isEmpty())
        widget = widget->parentWidget();
    if (widget == nullptr) {
        QWhatsThis::showText(window->mapToGlobal(window->rect().center()),
                             QObject::tr("Nothing has the focus. Press Tab to move it, ? for all keys."), window);
        return;
    }
    const auto text = widget->whatsThis().isEmpty() ? widget->toolTip() : widget->whatsThis();
    QWhatsThis::showText(widget->mapToGlobal(QPoint(0, widget->height())), text, widget);
}

}  // namespace tacto::gui
