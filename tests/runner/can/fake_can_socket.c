// Loaded before candump (LD_PRELOAD), gives it a CAN socket that delivers the frames of a file: FERNLICHT_FRAMES. So candump prints frames
// that we chose on a machine without CAN.
#define _GNU_SOURCE
#include <errno.h>
#include <net/if.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/time.h>

/// As tests/runner/can/candump_test.cpp writes it.
struct record {
    int64_t seconds, microseconds;
    char channel[16];
    uint32_t bytes; ///< 16: classic, 72: CAN FD
    uint32_t sent, lost;
    uint32_t frame[18]; ///< struct can_frame or canfd_frame
};

static char channels[32][16];

/// From 1 up.
static int index_of(const char* name) {
    for (int i = 1; i < 32; ++i) {
        if (channels[i][0] == '\0')
            memcpy(channels[i], name, sizeof channels[i]);
        if (strncmp(channels[i], name, sizeof channels[i]) == 0)
            return i;
    }
    abort();
}

int socket(int domain, int type, int protocol) {
    (void)domain, (void)type, (void)protocol;
    return eventfd(1, 0); // can always be read
}

int bind(int fd, const struct sockaddr* address, socklen_t length) {
    (void)fd, (void)address, (void)length;
    return 0;
}

int setsockopt(int fd, int level, int option, const void* value, socklen_t length) {
    (void)fd, (void)level, (void)option, (void)value, (void)length;
    return 0;
}

int ioctl(int fd, unsigned long request, ...) {
    (void)fd;
    va_list arguments;
    va_start(arguments, request);
    struct ifreq* about = va_arg(arguments, struct ifreq*);
    va_end(arguments);
    if (request == 0x8933) // SIOCGIFINDEX
        about->ifr_ifindex = index_of(about->ifr_name);
    else if (request == 0x8910) // SIOCGIFNAME
        memcpy(about->ifr_name, channels[about->ifr_ifindex], sizeof about->ifr_name);
    else
        return errno = EINVAL, -1;
    return 0;
}

static void* add_message(struct msghdr* message, size_t* used, int type, size_t bytes) {
    struct cmsghdr* part = (struct cmsghdr*)((char*)message->msg_control + *used);
    *used += CMSG_SPACE(bytes);
    if (*used > message->msg_controllen)
        abort();
    part->cmsg_level = SOL_SOCKET;
    part->cmsg_type = type;
    part->cmsg_len = CMSG_LEN(bytes);
    return CMSG_DATA(part);
}

ssize_t recvmsg(int fd, struct msghdr* message, int flags) {
    (void)fd, (void)flags;
    static FILE* file = NULL;
    static uint32_t lost = 0;
    if (!file)
        file = fopen(getenv("FERNLICHT_FRAMES"), "rb");
    struct record record;
    if (!file || fread(&record, sizeof record, 1, file) != 1)
        return errno = EIO, -1;
    memcpy(message->msg_iov[0].iov_base, record.frame, record.bytes);
    int index = index_of(record.channel);
    memcpy((char*)message->msg_name + 4, &index, sizeof index); // can_ifindex of sockaddr_can
    message->msg_flags = record.sent ? MSG_DONTROUTE : 0;
    size_t used = 0;
    memset(message->msg_control, 0, message->msg_controllen);
    struct timeval stamp = {record.seconds, record.microseconds};
    memcpy(add_message(message, &used, SO_TIMESTAMP, sizeof stamp), &stamp, sizeof stamp);
    lost += record.lost;
    memcpy(add_message(message, &used, SO_RXQ_OVFL, sizeof lost), &lost, sizeof lost);
    message->msg_controllen = used;
    return (ssize_t)record.bytes;
}
