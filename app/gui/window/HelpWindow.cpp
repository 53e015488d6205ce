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

#include "app/gui/look/Look.h"
#include "app/gui/look/Text.h"
#include "app/scripting/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

QString definitions() {
    const auto resources = resourcesFolder();
    if (!resources) return QString::fromStdString(resources.error().message);
    QFile file(QString::fromStdString((*resources / "help" / "definitions.md").string()));
    if (!file.open(QIODevice::ReadOnly)) return QObject::tr("%1 cannot be read.").arg(file.fileName());
    return QString::fromUtf8(file.readAll());
}

QString limitsAsHtml(const ShippedLimits& limits) {
    QString html;
    for (const auto& set : limits.sets) {
        html += QString("<h3>%1 (%2)</h3><table cellspacing=\"0\" cellpadding=\"4\">")
                    .arg(qtext(set.title).toHtmlEscaped(), qtext(set.id).toHtmlEscaped());
        html += QString(
                    "<tr><th align=\"left\">%1</th><th align=\"left\">%2</th><th align=\"left\">%3</th>"
                    "<th align=\"left\">%4</th></tr>")
                    .arg(QObject::tr("Quantity"), QObject::tr("Limit"), QObject::tr("Judged"), QObject::tr("Source"));
        for (const auto& row : set.rows) {
            const auto limit =
                QString("%1 %2").arg(row.strict ? "<" : "≤", settingText(row.max, qtext(unitOf(row.quantity))));
            const auto judged = row.judged == JudgedAt::Ohm500 ? QObject::tr("into 500 Ω")
                                                               : QObject::tr("worst case over the load range");
            auto action = row.action == LimitAction::Refuse ? QString()
                          : row.action == LimitAction::Warn ? QObject::tr(" (a warning)")
                                                            : QObject::tr(" (to be stated)");
            html += QString("<tr><td>%1</td><td>%2%3</td><td>%4</td><td>%5</td></tr>")
                        .arg(qtext(titleOf(row.quantity)), limit.toHtmlEscaped(), action, judged,
                             qtext(row.source).toHtmlEscaped());
        }
        html += "</table>";
    }
    return html;
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
constexpr const char* kBench = QT_TRANSLATE_NOOP("Keys", "Bench and protocols");
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
          {"F11", QT_TRANSLATE_NOOP("Keys", "full screen")},
          {"Ctrl+Q", QT_TRANSLATE_NOOP("Keys", "output off and quit")}}},
        {kBench,
         {{"Ctrl+B", QT_TRANSLATE_NOOP("Keys", "opens the simulated bench")},
          {"Ctrl+O", QT_TRANSLATE_NOOP("Keys", "opens a recording, session or capture")},
          {"Ctrl+Shift+A", QT_TRANSLATE_NOOP("Keys", "arms: the first of two steps")},
          {"F5", QT_TRANSLATE_NOOP("Keys", "runs the protocol")},
          {"Shift+F5", QT_TRANSLATE_NOOP("Keys", "stops the protocol")}}},
        {kScopeKeys,
         {{"S, N, A", QT_TRANSLATE_NOOP("Keys", "single, normal, auto")},
          {"Wheel, Ctrl+Wheel", QT_TRANSLATE_NOOP("Keys", "zooms time, level")},
          {"Drag", QT_TRANSLATE_NOOP("Keys", "pans")},
          {"Shift+Drag", QT_TRANSLATE_NOOP("Keys", "zooms into a box")},
          {"Double click", QT_TRANSLATE_NOOP("Keys", "fits all")},
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
    auto* second = page(tabs);
    second->setHtml(limitsAsHtml(limits));
    tabs->addTab(second, QObject::tr("&Limits"));
    layout->addWidget(tabs);
    addClose(*dialog, *layout);
    const auto metrics = dialog->fontMetrics();
    dialog->resize(metrics.averageCharWidth() * 105, metrics.height() * 34);
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
