#include "app/gui/window/RecordingLine.h"

#include <QDateTime>
#include <QDialog>
#include <QFileInfo>
#include <QPlainTextEdit>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/Printable.h"

namespace tacto::gui {

namespace {
constexpr int kLogLines = 2000;
constexpr int kRecordingChars = 12;  // "● recording" stays even if the message is long

QString sizeText(qint64 bytes) { return QLocale::c().formattedDataSize(bytes, 1, QLocale::DataSizeSIFormat); }
}  // namespace

RecordingLine::RecordingLine(BenchController& controller, QStatusBar& bar)
    : QObject(&bar), controller_(controller), bar_(bar) {
    recording_ = makeLabel<ElidedLabel>({}, {.name = "recording"}, &bar);
    recording_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // makes room for the message
    bar.addWidget(recording_, 1);
    message_ = new QToolButton(&bar);
    message_->setObjectName("lastMessage");
    message_->setAutoRaise(true);
    message_->setMinimumWidth(1);  // so that a long message does not widen the window
    message_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
    message_->setToolTip(tr("The last message. Click for the log."));
    message_->setText(tr("No messages"));
    connect(message_, &QToolButton::clicked, this, &RecordingLine::showLog);
    bar.addPermanentWidget(message_);
    bar.installEventFilter(this);
    fixHeight();
    afterLookChange(bar, [this] {
        fixHeight();
        fitMessage();
    });
    sayRecording(tr("Nothing is being recorded"));
    refresh();
}

void RecordingLine::refresh() {
    const auto open = controller_.open();
    if (!open) {
        if (!session_.empty()) sayRecorded(std::exchange(session_, {}));
        return;
    }
    if (open->session != session_) {
        session_ = open->session;
        since_.restart();
        looked_.invalidate();
    }
    if (looked_.isValid() && looked_.elapsed() < 500) return;
    looked_.restart();
    const QFileInfo file(QString::fromStdString(session_.string()));
    const QFileInfo wal(QString::fromStdString(session_.string() + "-wal"));
    const auto seconds = since_.elapsed() / 1000;
    const auto savedAt = wal.exists() ? std::max(wal.lastModified(), file.lastModified()) : file.lastModified();
    const double age = double(savedAt.msecsTo(QDateTime::currentDateTime())) / 1000;
    const auto lasts = tr("● recording %1:%2:%3")
                           .arg(seconds / 3600, 2, 10, QChar('0'))
                           .arg(seconds / 60 % 60, 2, 10, QChar('0'))
                           .arg(seconds % 60, 2, 10, QChar('0'));
    recording_->setAccessibleDescription(QString::fromStdString(session_.string()));
    if (blind_) return sayRecording(lasts);
    sayRecording(tr("%1 · %2 · saved %3 s ago")
                     .arg(lasts, sizeText(file.size() + wal.size()))
                     .arg(std::max(0.0, age), 0, 'f', 1));
}

void RecordingLine::setBlind(bool blind) {
    blind_ = blind;
    looked_.invalidate();
    refresh();
}

void RecordingLine::sayRecording(const QString& text) {
    recording_->setText(text);
    recording_->setToolTip(text + '\n' +
                           tr("Every open bench records to a session file. Samples are on disk within a second, "
                              "events and trials at once."));
}

/// Names a finished session only if it still exists.
void RecordingLine::sayRecorded(const std::filesystem::path& session) {
    const QFileInfo file(QString::fromStdString(session.string()));
    sayRecording(file.exists() ? tr("Recorded to %1 · %2").arg(file.fileName(), sizeText(file.size()))
                               : tr("Nothing is being recorded"));
}

QString RecordingLine::shown(const QString& text) const {
    return blind_ ? qtext(withoutNumbers(text.toStdString())) : text;
}

void RecordingLine::say(const QString& message, bool isError) {
    const auto text = shown(message);
    const auto time = QDateTime::currentDateTime().toString("HH:mm:ss");
    log_ << QString("%1  %2").arg(time, text);
    while (log_.size() > kLogLines) log_.removeFirst();
    said_ = time + ' ' + text;
    fitMessage();
    message_->setToolTip(text + tr("\nClick for the log."));
    auto colour = message_->palette();
    colour.setColor(QPalette::ButtonText, isError ? colours().amberText : bar_.palette().color(QPalette::WindowText));
    message_->setPalette(colour);
}

bool RecordingLine::saysOff() const { return said_.contains(tr("Output is off")) || said_.contains(tr("Disarmed")); }

/// A sign from a taller font ("→") must not make the bar, and with it every dock, higher or lower.
void RecordingLine::fixHeight() {
    const auto text = message_->text();
    message_->setText(tr("No messages"));
    message_->setFixedHeight(message_->sizeHint().height());
    message_->setText(text);
    recording_->setFixedHeight(message_->minimumHeight());
}

void RecordingLine::fitMessage() {
    if (said_.isEmpty()) return;
    const auto metrics = message_->fontMetrics();
    int room = bar_.width() - metrics.averageCharWidth() * kRecordingChars -
               (message_->sizeHint().width() - metrics.horizontalAdvance(message_->text()));
    for (const auto* part : bar_.findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
        if (part != message_ && part != recording_ && !part->isHidden()) room -= part->sizeHint().width();
    message_->setText(metrics.elidedText(said_, Qt::ElideRight, room));
    if (auto* layout = bar_.layout()) layout->activate();  // otherwise a longer text would be cut until the next layout
}

bool RecordingLine::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &bar_ && event->type() == QEvent::Resize) fitMessage();
    return QObject::eventFilter(watched, event);
}

void RecordingLine::showLog() {
    auto* dialog = new QDialog(bar_.window());
    dialog->setWindowTitle(tr("Messages"));
    auto* layout = new QVBoxLayout(dialog);
    auto* text = new QPlainTextEdit(log_.isEmpty() ? tr("No messages yet.") : log_.join("\n"), dialog);
    text->setReadOnly(true);
    text->setTabChangesFocus(true);
    layout->addWidget(text);
    addCloseButton(*dialog, *layout);
    dialog->resize(text->fontMetrics().averageCharWidth() * 90, text->fontMetrics().height() * 24);
    openDialog(dialog);
}

}  // namespace tacto::gui

#include "moc_RecordingLine.cpp"
