#include "app/gui/theme/Dialogs.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QDesktopServices>
#include <QDialogButtonBox>
#include <QEvent>
#include <QFileDialog>
#include <QFileIconProvider>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLayout>
#include <QLineEdit>
#include <QListView>
#include <QProcess>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QShortcut>
#include <QStandardPaths>
#include <QTreeView>
#include <QUrl>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/Told.h"

namespace tacto::gui {

namespace {

using Wants = FileQuestion::Wants;

constexpr const char* kLastFolder = "lastFolder";  // of QSettings

/// Chooses icons by file name. Qt's own provider opens each file to find its type, and closing any descriptor of a file
/// releases the process's locks on that file: also the locks with which SQLite protects the index of a session being
/// recorded from other programs (hazard H8).
class UnopenedFiles final : public QFileIconProvider {
public:
    using QFileIconProvider::icon;
    [[nodiscard]] QIcon icon(const QFileInfo& info) const override { return icon(info.isDir() ? Folder : File); }
    [[nodiscard]] QString type(const QFileInfo& info) const override {
        if (info.isDir()) return QObject::tr("Folder");
        return info.suffix().isEmpty() ? QObject::tr("File") : QObject::tr("%1 file").arg(info.suffix());
    }
};

/// Qt's own file dialog. Questions that Qt would ask in modal boxes appear in its last line instead.
class FileChooser final : public QFileDialog {
public:
    // Starts in the root folder, which has only folders: Qt opens the listed files until the icon provider is set.
    FileChooser(QWidget* parent, const FileQuestion& question) : QFileDialog(parent, question.title, QDir::rootPath()) {
        static UnopenedFiles files;
        setIconProvider(&files);
        setObjectName("fileChooser");
        // The desktop's own dialog would keep all its keys, even Esc and Pause.
        setOptions(DontUseNativeDialog | DontConfirmOverwrite);
        const bool folder = question.wants == Wants::Folder || question.wants == Wants::NewFolder;
        makes_ = question.wants == Wants::NewFolder;
        setFileMode(folder ? Directory : question.wants == Wants::NewFile ? AnyFile : ExistingFile);
        setOption(ShowDirsOnly, folder);
        setAcceptMode(question.wants == Wants::NewFile ? AcceptSave : AcceptOpen);
        if (!question.filters.isEmpty()) setNameFilters(question.filters);
        setDirectory(!question.folder.isEmpty() ? question.folder : lastFolder());
        if (!question.suffix.isEmpty()) setDefaultSuffix(question.suffix);
        if (!question.name.isEmpty()) selectFile(question.name);
        // The dialog only chooses files. Deleting files from it would open a modal box.
        for (auto* view : findChildren<QAbstractItemView*>()) view->setContextMenuPolicy(Qt::NoContextMenu);
        if (auto* list = findChild<QTreeView*>("treeView"); list != nullptr) {
            // Names need the room, and they already show the file type.
            constexpr int kType = 2, kSampled = 50;
            auto& header = *list->header();
            header.setSectionHidden(kType, true);
            header.setStretchLastSection(false);
            header.setResizeContentsPrecision(kSampled);
            for (int column = 0; column < header.count(); ++column)
                header.setSectionResizeMode(column, column == 0 ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
        }
        if (auto* places = findChild<QListView*>("sidebar"); places != nullptr) {
            constexpr int kMargin = 24, kMaxWidth = 240;
            places->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
            places->setMinimumWidth(std::min(places->sizeHintForColumn(0) + kMargin, kMaxWidth));
        }
        for (auto* shortcut : findChildren<QShortcut*>()) {
            if (shortcut->key() == QKeySequence(QKeySequence::Delete)) shortcut->setEnabled(false);
        }
        says_ = makeLabel({}, {.name = "fileTrouble", .wraps = true}, this);
        says_->hide();
        if (auto* grid = qobject_cast<QGridLayout*>(layout()))
            grid->addWidget(says_, grid->rowCount(), 0, 1, grid->columnCount());
        if (auto* name = findChild<QLineEdit*>("fileNameEdit"))
            connect(name, &QLineEdit::textChanged, says_, &QLabel::hide);
        if (makes_) offerNames();
        constexpr int kWidth = 110;  // characters; enough for the names of sessions with size and date
        resize(std::max(width(), kWidth * fontMetrics().averageCharWidth()), height());
    }

    void accept() override {
        const auto files = selectedFiles();
        if (files.isEmpty()) return;
        QFileInfo file(files.first());
        if (makes_ && !file.exists()) {
            if (!QDir().mkpath(file.absoluteFilePath()))
                return say(QObject::tr("⚠ %1 cannot be made there. Choose another place.").arg(file.fileName()));
            file.refresh();
        }
        if (acceptMode() == AcceptOpen && !file.exists() && file.fileName().contains(QChar::ReplacementCharacter))
            return say(QObject::tr("⚠ The name of %1 is not UTF-8. Rename it first.").arg(file.fileName()));
        if (acceptMode() == AcceptOpen && !file.exists())
            return say(QObject::tr("⚠ %1 is not there. Choose another name.").arg(file.fileName()));
        const bool replaces = acceptMode() == AcceptSave && file.isFile();
        if (replaces && std::exchange(replaces_, file.absoluteFilePath()) != file.absoluteFilePath())
            return say(QObject::tr("⚠ %1 exists. Press Save again to replace it.").arg(file.fileName()));
        QSettings().setValue(kLastFolder, file.absolutePath());
        QFileDialog::accept();
    }

private:
    /// The folder in which something was chosen last, perhaps on an earlier day; at first the one that this program
    /// proposes for what it makes.
    static QString lastFolder() {
        const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
        for (const auto& folder : {QSettings().value(kLastFolder).toString(), documents + "/Tactoscope", documents})
            if (!folder.isEmpty() && QFileInfo(folder).isDir()) return folder;
        return QDir::homePath();
    }
    /// Qt greys the button out for a folder that is not there yet, though Return takes its name.
    void offerNames() {
        auto* name = findChild<QLineEdit*>("fileNameEdit");
        auto* box = findChild<QDialogButtonBox*>();
        auto* choose = box == nullptr ? nullptr : box->button(QDialogButtonBox::Open);
        if (name == nullptr || choose == nullptr) return;
        const auto follow = [name, choose] { choose->setEnabled(!name->text().trimmed().isEmpty()); };
        onEvent(*choose, QEvent::EnabledChange, follow);
        connect(name, &QLineEdit::textChanged, choose, follow);
        follow();
    }
    void say(const QString& what) {
        says_->setText(what);
        says_->show();
    }
    QLabel* says_;
    bool makes_ = false;  ///< the dialog may make a folder that does not exist
    QString replaces_;    ///< the existing file that the operator was warned about
};

/// Returns the same dialog if it is already open, else null.
QDialog* openTwin(const QDialog& dialog) {
    for (auto* widget : QApplication::topLevelWidgets()) {
        auto* other = qobject_cast<QDialog*>(widget);
        if (other != nullptr && other != &dialog && other->isVisible() && other->metaObject() == dialog.metaObject() &&
            other->parentWidget() == dialog.parentWidget() && other->windowTitle() == dialog.windowTitle())
            return other;
    }
    return nullptr;
}

/// Pixels for the frame that a window manager adds above and at the sides of a window.
constexpr int kTitleBar = 30, kFrame = 4;

/// Returns the height at which the whole content is visible.
int neededHeight(const QWidget& dialog, int width) {
    const auto* layout = dialog.layout();
    if (layout == nullptr) return dialog.minimumHeight();
    return layout->hasHeightForWidth() ? layout->totalHeightForWidth(width) : layout->totalMinimumSize().height();
}

/// Makes the dialog narrower, with more lines of text, if it would cover STOP otherwise.
void makeRoomForStop(QWidget& dialog, const QRect& room, int stopsLeft) {
    const int beside = stopsLeft - kFrame - room.left();
    const int least = std::max(dialog.minimumWidth(), dialog.minimumSizeHint().width());
    if (dialog.width() > beside && least <= beside && neededHeight(dialog, beside) <= room.height())
        dialog.resize(beside, dialog.height());
}

}  // namespace

void place(QWidget& dialog) {
    if (dialog.parentWidget() == nullptr) return;
    const auto* window = dialog.parentWidget()->window();
    const auto screen = window->screen()->availableGeometry();
    auto room = screen;
    dialog.ensurePolished();
    if (!dialog.testAttribute(Qt::WA_Resized)) dialog.adjustSize();
    if (const auto* bar = window->findChild<const QWidget*>("safetyBar"); bar != nullptr) {
        const int below = bar->mapToGlobal(QPoint(0, bar->height())).y() + kTitleBar;
        if (room.contains(room.left(), below)) room.setTop(below);
    }
    int needed = neededHeight(dialog, dialog.width());
    if (needed > room.height()) {  // the dialog covers the bar next to STOP if it needs that height
        const int title = dialog.isVisible() ? dialog.geometry().top() - dialog.frameGeometry().top() : kTitleBar;
        room = screen.adjusted(0, title, 0, 0);
        if (const auto* stop = window->findChild<const QWidget*>("stopButton"); stop != nullptr) {
            const int stopsLeft = stop->mapToGlobal(QPoint()).x();
            makeRoomForStop(dialog, room, stopsLeft);
            needed = neededHeight(dialog, dialog.width());
            room.setRight(std::max(stopsLeft - 1, room.left() + dialog.width()));
        }
        room.setTop(std::max(room.top(), room.bottom() - needed));
    }
    dialog.resize(dialog.size().expandedTo({0, needed}));
    dialog.setMinimumHeight(std::min(dialog.minimumHeight(), room.height()));
    if (auto* layout = dialog.layout(); layout != nullptr && layout->minimumSize().height() > room.height())
        layout->setSizeConstraint(QLayout::SetNoConstraint);
    dialog.resize(dialog.size().boundedTo(room.size()));
    const int top = window->geometry().top() + (window->height() - dialog.height()) / 2;
    const int left = window->geometry().left() + (window->width() - dialog.width()) / 2;
    dialog.move(std::max(room.left(), std::min(left, room.right() - dialog.width())),
                std::max(room.top(), std::min(top, room.bottom() - dialog.height())));
}

void openDialog(QDialog* dialog) {
    if (auto* twin = openTwin(*dialog)) {
        dialog->deleteLater();
        dialog = twin;
    } else {
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setWindowModality(Qt::NonModal);
        place(*dialog);
        dialog->show();
    }
    dialog->raise();
    dialog->activateWindow();
}

void addCloseButton(QDialog& dialog, QLayout& layout) {
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, &dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::close);
    layout.addWidget(buttons);
}

QString openOnDesktop(const QString& path) {
    const auto none = QObject::tr("This desktop has no program that opens %1.").arg(path);
    const auto url = QUrl::fromLocalFile(path);
    const auto opener = QStandardPaths::findExecutable("xdg-open");
    const auto platform = QGuiApplication::platformName();
    const bool desktop = platform == "xcb" || platform.startsWith("wayland");
    if (!desktop || opener.isEmpty() || QFile::exists("/.flatpak-info"))
        return QDesktopServices::openUrl(url) ? QString() : none;
    // Qt would start the same program and never learn whether it found one for the file.
    auto* process = new QProcess;
    const auto end = [process, none](bool opened) {
        if (!opened) tell(none);
        process->deleteLater();
    };
    QObject::connect(process, &QProcess::finished, [end](int code) { end(code == 0); });
    QObject::connect(process, &QProcess::errorOccurred, [end](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart) end(false);
    });
    process->setStandardOutputFile(QProcess::nullDevice());
    process->setStandardErrorFile(QProcess::nullDevice());
    process->start(opener, {url.toString(QUrl::FullyEncoded)});
    return {};
}

void askForFile(QWidget& asking, const FileQuestion& question, std::function<void(const QString& path)> then) {
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    auto* chooser = new FileChooser(&asking, question);
    QObject::connect(chooser, &QFileDialog::fileSelected, &asking, std::move(then));
    openDialog(chooser);
}

namespace {

class ContentGrowth final : public QObject {
public:
    explicit ContentGrowth(QDialog& dialog) : QObject(&dialog), dialog_(dialog) { dialog.installEventFilter(this); }
    bool eventFilter(QObject* /*watched*/, QEvent* event) override {
        const bool changed = event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show;
        if (!changed || std::exchange(queued_, true)) return false;
        const auto turn = [this] {
            queued_ = false;
            grow();
        };
        QMetaObject::invokeMethod(this, turn, Qt::QueuedConnection);
        return false;
    }

private:
    void grow() {
        const auto* layout = dialog_.layout();
        if (layout == nullptr) return;
        auto wanted = dialog_.size().expandedTo(layout->totalMinimumSize());
        if (layout->hasHeightForWidth())
            wanted.setHeight(std::max(wanted.height(), layout->totalHeightForWidth(wanted.width())));
        const auto frame = dialog_.frameGeometry().size() - dialog_.size();
        wanted = wanted.boundedTo((dialog_.screen()->availableSize() - frame).expandedTo(dialog_.size()));
        if (wanted != dialog_.size()) dialog_.resize(wanted);
        const int bottom = dialog_.screen()->availableGeometry().bottom();
        if (dialog_.isVisible() && dialog_.frameGeometry().bottom() > bottom) place(dialog_);
    }
    QDialog& dialog_;
    bool queued_ = false;
};

}  // namespace

void growWithContent(QDialog& dialog) { new ContentGrowth(dialog); }

}  // namespace tacto::gui
