#include "app/gui/window/FileMenu.h"

#include <QMenuBar>
#include <QShortcut>

#include "app/gui/theme/Text.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/Workspaces.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

FileMenu::FileMenu(MainWindow& window, Workspaces& workspaces, RecordingLine& line)
    : QObject(&window),
      window_(window),
      workspaces_(workspaces),
      line_(line),
      menu_(window.menuBar()->addMenu(tr("&File"))) {
    menu_->setToolTipsVisible(true);
    menu_->addAction(tr("&Open…"), QKeySequence::Open, &window_, &MainWindow::chooseFile);
    menu_->addAction(tr("Open &recording folder…"), &window_, &MainWindow::chooseRecording);
    menu_->addAction(tr("Open the &example recording"), &window_, [this] {
        if (const auto resources = resourcesFolder())
            window_.openFile(QString::fromStdString((*resources / "examples" / "four-touches").string()));
    });
    recent_ = menu_->addMenu(tr("Re&cent"));
    connect(recent_, &QMenu::aboutToShow, this, &FileMenu::fillRecent);
    menu_->addSeparator();
    add(
        tr("&Save picture…"), QKeySequence::Save, tr("This page shows no picture."),
        [this] { return workspaces_.hasPicture(); }, [this] { workspaces_.askSavePicture(); });
    add(
        tr("E&xport…"), QKeySequence(Qt::CTRL | Qt::Key_E), tr("This page has no data to export."),
        [this] { return workspaces_.canExport(); }, [this] { workspaces_.askExport(); });
    add(
        tr("&Print…"), QKeySequence::Print, tr("This page has no report and no picture to print."),
        [this] { return workspaces_.hasPicture() || !workspaces_.report().isEmpty(); }, [this] { print(); });
    menu_->addSeparator();
    add(
        tr("C&lose"), QKeySequence::Close, tr("Nothing is open, or a run has the bench."),
        [this] { return workspaces_.canClose(); }, [this] { workspaces_.closeFile(); });
    menu_->addAction(tr("&Quit"), QKeySequence(Qt::CTRL | Qt::Key_Q), &window_, &QWidget::close);
    if (auto* key = window_.findChild<QShortcut*>("savePictureKey")) key->setEnabled(false);
    connect(&printer_, &ReportPrinter::said, this, [this](const QString& what) { line_.say(what); });
}

void FileMenu::add(const QString& text, const QKeySequence& key, const QString& none, std::function<bool()> has,
                   std::function<void()> act) {
    auto* action = menu_->addAction(text, this, [this, none, has, act] { has() ? act() : line_.say(none); });
    action->setShortcut(key);
    connect(menu_, &QMenu::aboutToShow, this, [action, none, has] {
        action->setEnabled(has());
        action->setToolTip(action->isEnabled() ? QString() : none);
    });
    connect(menu_, &QMenu::aboutToHide, this, [action] { action->setEnabled(true); });  // so that its key can say why
}

void FileMenu::fillRecent() {
    recent_->clear();
    const auto files = recentFiles();
    for (const auto& path : files) recent_->addAction(path, &window_, [this, path] { window_.openFile(path); });
    if (files.isEmpty()) recent_->addAction(tr("nothing yet"))->setEnabled(false);
}

/// Offers the printers for the page's report, or else for its picture.
void FileMenu::print() {
    auto pdf = workspaces_.report();
    if (pdf.isEmpty()) {
        pdf = drawn_.filePath("tactoscope.pdf");
        if (const auto wrong = workspaces_.savePicture(pdf)) return line_.say(*wrong, true);
    }
    auto* printers = new QMenu(tr("Print"), &window_);
    printers->setObjectName("printers");
    printers->setAttribute(Qt::WA_DeleteOnClose);
    printer_.offer(*printers, pdf);
    printers->popup(window_.mapToGlobal(window_.rect().center()));
}

}  // namespace tacto::gui

#include "moc_FileMenu.cpp"
