// ReportMaker.h - draws reports in a child process, so that the window never stalls and survives a crash:
// `tactoscope-report SESSION --out FILE`, a program in the same folder. For a sealed study the child gets the
// passphrase through a pipe, from locked memory.
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
    ~ReportMaker() override;  ///< ends the present report
    /// Adds a report to the queue. `out` ends in .pdf or .html. Each report ends with done() or failed().
    void make(const QString& session, const QString& out);
    struct Order {
        QString record, out;  ///< session or study folder
        QStringList more{};   ///< additional command-line arguments
        std::shared_ptr<const Secret> passphrase{};
        QString assurance{};  ///< added to an error message: "The session is complete."
        QString signs{};      ///< the record in which a signature of the report is noted; for done()
    };
    void make(const Order& order);
    /// Ends the present report, with failed(), and empties the queue. No half-written file remains.
    void cancel();
    [[nodiscard]] bool busy() const { return process_.state() != QProcess::NotRunning || !queue_.isEmpty(); }

signals:
    void done(const QString& out, const QString& signs);
    void failed(const QString& why);

private:
    void next();
    void ended(int code, QProcess::ExitStatus status);
    QProcess process_;
    void start(const QStringList& words, const Secret* passphrase);
    QList<Order> queue_;
    QString out_;
    int writer_ = 0;  ///< the process that writes out_
    QString assurance_;
    QString signs_;
    bool cancelled_ = false;  // true if the user cancelled, so that no error is shown
};

}  // namespace tacto::gui
