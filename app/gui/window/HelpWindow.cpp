#include "app/gui/window/HelpWindow.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>
#include <QVBoxLayout>
#include <QWhatsThis>
#include <array>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/LimitSetView.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/Workspaces.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr int kGuideColumns = 130;  ///< average characters that the window is wide

/// Shows Markdown pages, and pictures no wider than they.
class GuideBrowser final : public QTextBrowser {
public:
    using QTextBrowser::QTextBrowser;

protected:
    QVariant loadResource(int type, const QUrl& name) override {
        if (type != QTextDocument::ImageResource) return QTextBrowser::loadResource(type, name);
        const QImage picture(source().resolved(name).toLocalFile());
        const int width = fontMetrics().averageCharWidth() * (kGuideColumns - 20);
        return picture.width() <= width ? picture : picture.scaledToWidth(width, Qt::SmoothTransformation);
    }
};

/// Wraps long commands, which Qt keeps on one line.
void wrapCommands(QTextDocument& page) {
    QTextCursor cursor(&page);
    for (auto block = page.begin(); block.isValid(); block = block.next()) {
        if (!block.blockFormat().nonBreakableLines()) continue;
        cursor.setPosition(block.position());
        auto format = block.blockFormat();
        format.setNonBreakableLines(false);
        cursor.setBlockFormat(format);
    }
}

QWidget* makeGuide(const QString& page, QWidget* parent) {
    auto* guide = new QWidget(parent);
    auto* layout = new QVBoxLayout(guide);
    auto* tools = new QHBoxLayout;
    auto* contents = new QPushButton(QObject::tr("&Contents"), guide);
    auto* back = new QPushButton(QObject::tr("&Back"), guide);
    for (auto* button : {contents, back}) {
        button->setAutoDefault(false);
        tools->addWidget(button);
    }
    tools->addStretch();
    layout->addLayout(tools);
    auto* browser = new GuideBrowser(guide);
    browser->setObjectName("guide");
    browser->setAccessibleName(QObject::tr("Guide"));
    layout->addWidget(browser);
    QObject::connect(browser, &QTextBrowser::sourceChanged, browser, [browser] { wrapCommands(*browser->document()); });
    back->setEnabled(false);
    QObject::connect(browser, &QTextBrowser::backwardAvailable, back, &QWidget::setEnabled);
    QObject::connect(back, &QPushButton::clicked, browser, &QTextBrowser::backward);
    const auto resources = resourcesFolder();
    if (!resources) {
        browser->setPlainText(QString::fromStdString(resources.error().message));
        contents->setEnabled(false);
        return guide;
    }
    const auto at = [folder = *resources / "help" / "guide"](const QString& name) {
        return QUrl::fromLocalFile(QString::fromStdString((folder / name.toStdString()).string()));
    };
    QObject::connect(contents, &QPushButton::clicked, browser, [browser, at] { browser->setSource(at("index.md")); });
    browser->setSource(at(page));
    return guide;
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
          {"F1", QT_TRANSLATE_NOOP("Keys", "the guide, at the page of this workspace")},
          {"Shift+F1", QT_TRANSLATE_NOOP("Keys", "explains what has the focus")},
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

QString guidePageOf(const Workspaces& workspaces) {
    if (workspaces.showsScope()) return "oscilloscope.md";
    static constexpr std::array kPages{
        "live.md",     "stimulator-calibration.md", "load-safety.md", "separability.md", "pilot.md", "sessions.md",
        "protocols.md"};
    return kPages.at(static_cast<std::size_t>(workspaces.currentIndex()));
}

void openGuide(const ShippedLimits& limits, const QString& page, QWidget* parent) {
    if (auto* browser = parent->findChild<QTextBrowser*>("guide")) {
        browser->setSource(QUrl(page));
        browser->window()->findChild<QTabWidget*>()->setCurrentIndex(0);
        browser->window()->raise();
        browser->window()->activateWindow();
        return;
    }
    auto* dialog = new QDialog(parent);
    dialog->setWindowTitle(QObject::tr("Guide"));
    auto* layout = new QVBoxLayout(dialog);
    auto* tabs = new QTabWidget(dialog);
    tabs->addTab(makeGuide(page, tabs), QObject::tr("&Guide"));
    tabs->addTab(new LimitSetView(limits.sets, tabs), QObject::tr("&Limits"));
    layout->addWidget(tabs);
    addClose(*dialog, *layout);
    const auto metrics = dialog->fontMetrics();
    dialog->resize(metrics.averageCharWidth() * kGuideColumns, metrics.height() * 34);
    openDialog(dialog);
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
