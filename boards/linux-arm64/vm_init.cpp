// /init of the virtual machine that run.py starts: mounts, loads modules, runs programs, says how each ended, powers
// off.
//
// Behind "--" on the kernel's command line stands a file with a program and its arguments in every line; before these
// words may stand `user=N`, a user and group to run as, `groups=N,N`, that user's other groups, `stop`, to send SIGTERM
// when a byte comes from the console, and `beside`, to run the next program beside this one then.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <grp.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>
#include <utility>

namespace {

void sleep_ms(long ms) {
  const timespec pause{ms / 1000, ms % 1000 * 1'000'000};
  nanosleep(&pause, nullptr);
}

void mount_all() {
  const char* const kinds[][2] = {{"proc", "/proc"}, {"sysfs", "/sys"}, {"devtmpfs", "/dev"}};
  for (const auto& [kind, at] : kinds) {
    mkdir(at, 0755);
    if (mount(kind, at, kind, 0, nullptr) < 0 && errno != EBUSY)
      std::printf("init: %s: %s\n", at, std::strerror(errno));
  }
}

/// In the order of /modules/order, which names each after those it needs.
void load_modules() {
  std::FILE* const order = std::fopen("/modules/order", "r");
  if (order == nullptr) return;
  char path[160];
  while (std::fscanf(order, "%159s", path) == 1) {
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0 || syscall(SYS_finit_module, file, "", 0) < 0)
      std::printf("init: %s: %s\n", path, std::strerror(errno));
    if (file >= 0) close(file);
  }
  std::fclose(order);
}

/// As udev does by the package's rule and by Debian's own; the number of the group gpio is an arbitrary one.
void give_devices_to_groups() {
  constexpr gid_t kGpio = 990, kVideo = 44;
  for (const auto& [path, group] : {std::pair{"/dev/gpiochip0", kGpio}, std::pair{"/dev/dri/card0", kVideo}})
    if (access(path, F_OK) == 0 && (chown(path, 0, group) < 0 || chmod(path, 0660) < 0))
      std::printf("init: %s: %s\n", path, std::strerror(errno));
}

/// The console passes bytes on as they are, and lines end as on a terminal.
void make_console_raw() {
  termios settings;
  if (tcgetattr(STDIN_FILENO, &settings) < 0) return;
  cfmakeraw(&settings);
  settings.c_oflag |= OPOST | ONLCR;
  tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

struct Order {
  const char *user = nullptr, *groups = "";
  bool stop = false, beside = false;
  char* words[40] = {};  // of the program, a null at the end
};

Order order_of(char* line) {
  Order order;
  std::size_t count = 0;
  for (char* word = std::strtok(line, " \n"); word != nullptr; word = std::strtok(nullptr, " \n")) {
    if (count == 0 && std::strncmp(word, "user=", 5) == 0) order.user = word + 5;
    else if (count == 0 && std::strncmp(word, "groups=", 7) == 0) order.groups = word + 7;
    else if (count == 0 && std::strcmp(word, "stop") == 0) order.stop = true;
    else if (count == 0 && std::strcmp(word, "beside") == 0) order.beside = true;
    else if (count + 1 < sizeof order.words / sizeof *order.words) order.words[count++] = word;
  }
  return order;
}

[[noreturn]] void become(const Order& order) {
  if (order.user != nullptr) {
    const auto id = static_cast<uid_t>(std::strtoul(order.user, nullptr, 10));
    gid_t groups[8];
    std::size_t count = 0;
    for (const char* at = order.groups; *at != '\0' && count < sizeof groups / sizeof *groups;) {
      char* end;
      groups[count++] = static_cast<gid_t>(std::strtoul(at, &end, 10));
      at = *end == ',' ? end + 1 : "";
    }
    if (setgroups(count, groups) < 0 || setgid(id) < 0 || setuid(id) < 0) std::perror("init: user");
  }
  execv(order.words[0], order.words);
  std::printf("init: %s: %s\n", order.words[0], std::strerror(errno));
  std::fflush(stdout);
  _exit(127);
}

void run(const Order& order) {
  const pid_t child = fork();
  if (child == 0) become(order);
  if (order.stop || order.beside) {
    char byte;
    while (read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
    }
  }
  if (order.beside) return;
  if (order.stop) kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) std::printf("exit %d\n", WEXITSTATUS(status));
  else std::printf("killed by signal %d\n", WTERMSIG(status));
}

}  // namespace

int main(int count, char** arguments) {
  setvbuf(stdout, nullptr, _IOLBF, 0);
  mount_all();
  make_console_raw();
  load_modules();
  // A driver makes its device a moment after its module is in; a machine without one waits for the whole of it.
  for (int i = 0; i < 100 && access("/dev/dri/card0", F_OK) < 0; ++i) sleep_ms(10);
  give_devices_to_groups();
  std::FILE* const orders = count > 1 ? std::fopen(arguments[1], "r") : nullptr;
  if (orders == nullptr) std::printf("init: no file of programs behind -- on the kernel's command line\n");
  char line[1024];
  while (orders != nullptr && std::fgets(line, sizeof line, orders) != nullptr) run(order_of(line));
  std::fflush(stdout);
  tcdrain(STDOUT_FILENO);
  reboot(RB_POWER_OFF);
}
