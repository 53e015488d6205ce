#include "app/report/WholeFile.h"

#include <QSaveFile>
#include <cerrno>
#include <system_error>
#include <unistd.h>

namespace tacto {
namespace {

Error refusal(QSaveFile& file) {
    Error error{ErrorCode::Io, file.errorString().toStdString()};
    file.cancelWriting();
    return error;
}

}  // namespace

Result<void> writeWholeFile(const QString& path, const QByteArray& content) {
    QSaveFile file(path);
    // Unbuffered: each piece says at once whether it was written.
    if (!file.open(QIODevice::WriteOnly | QIODevice::Unbuffered)) return tl::unexpected(refusal(file));
    for (qsizetype done = 0; done < content.size();) {
        // A full disk takes a part first; only the next write says why it takes no more.
        const auto written = file.write(content.constData() + done, content.size() - done);
        if (written <= 0) return tl::unexpected(refusal(file));
        done += written;
    }
    // A file system that writes later says here that it has no room. Pipes and devices hold nothing to wait for.
    if (::fsync(file.handle()) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) {
        const int why = errno;
        file.cancelWriting();
        return fail(ErrorCode::Io, "{}", std::generic_category().message(why));
    }
    if (!file.commit()) return tl::unexpected(refusal(file));
    return {};
}

}  // namespace tacto
