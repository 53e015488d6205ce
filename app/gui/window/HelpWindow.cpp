#include "app/gui/window/HelpWindow.h"

#include <QApplication>
#include <QImage>
#include <QPushButton>
#include <QTabWidget>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>
#include <QVBoxLayout>
#include <QWhatsThis>
#include <array>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/LimitSetView.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/Workspaces.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptRun.h"

namespace tacto::gui {

namespace {

constexpr const char* kReferencePage = "reference.md";
constexpr int kGuideColumns = 130;  ///< width of the window in average characters

/// Shows Markdown pages. Pictures are never wider than the page.
class GuideBrowser final : public QTextBrowser {
public:
    using QTextBrowser::QTextBrowser;

protected:
    QVariant loadResource(int type, const QUrl& name) override {
        if (name.fileName() == kReferencePage) return QString::fromStdString(scriptReference());
        if (type != QTextDocument::ImageResource) return QTextBrowser::loadResource(type, name);
        const QImage picture(source().resolved(name).toLocalFile());
        const int width = fontMetrics().averageCharWidth() * (kGuideColumns - 20);
        return picture.width() <= width ? picture : picture.scaledToWidth(width, Qt::SmoothTransformation);
    }
};

/// Wraps long commands, which Qt would keep on one line, and leaves room below them, which Qt does not.
void wrapCommands(QTextDocument& page) {
    constexpr int kIndent = 12, kBelow = 8;
    QTextCursor cursor(&page);
    for (auto block = page.begin(); block.isValid(); block = block.next()) {
        if (!block.blockFormat().nonBreakableLines()) continue;
        cursor.setPosition(block.position());
        auto format = block.blockFormat();
        format.setNonBreakableLines(false);
        format.setLeftMargin(scaledPx(kIndent));
        if (!block.next().blockFormat().nonBreakableLines()) format.setBottomMargin(scaledPx(kBelow));
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
    nameWidget(*browser, "guide", QObject::tr("Guide"));
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
    addCloseButton(*dialog, *layout);
    const auto metrics = dialog->fontMetrics();
    dialog->resize(metrics.averageCharWidth() * kGuideColumns, metrics.height() * 34);
    openDialog(dialog);
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
