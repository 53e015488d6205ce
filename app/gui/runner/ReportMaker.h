// ReportMaker.h - draws reports in a child process, so that the window never stalls and a crash there takes nothing
// with it: `tactoscope-report SESSION --out FILE`, a program beside this one. It gets the passphrase of a
// sealed study through a pipe, from locked memory.
#pragma once

#include <QObject>
#include <QProcess>
#include <QStringList>
#include <memory>

#include "core/seal/Secret.h"

namespace tacto::gui {

class ReportMaker final : public QObject {
    Q_OBJECT
public:
    explicit ReportMaker(QObject* parent = nullptr);
    ~ReportMaker() override;  ///< ends what is being made
    /// Queued after what is being made. `out` ends in .pdf or .html. done() or failed() follows for each.
    void make(const QString& session, const QString& out);
    struct Order {
        QString record, out;  ///< a session, or a study's folder
        QStringList more{};   ///< further words of the command
        std::shared_ptr<const Secret> passphrase{};
        QString assurance{};  ///< said with what fails: "The session is complete."
    };
    void make(const Order& order);
    /// Ends what is being made, with failed(), and forgets the queue. Nothing half-written stays.
    void cancel();
    [[nodiscard]] bool busy() const { return process_.state() != QProcess::NotRunning || !queue_.isEmpty(); }

signals:
    void done(const QString& out);
    void failed(const QString& why);

private:
    void next();
    void ended(int code, QProcess::ExitStatus status);
    QProcess process_;
    void start(const QStringList& words, const Secret* passphrase);
    QList<Order> queue_;
    QString out_;
    int writer_ = 0;  ///< the process that writes it
    QString assurance_;
    bool cancelled_ = false;  // the person cancelled it, and needs no error
};

}  // namespace tacto::gui
