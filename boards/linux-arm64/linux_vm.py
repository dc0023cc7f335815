"""The virtual machine of linux-arm64: Debian's kernel, and an initramfs that holds the package and what it needs."""
import gzip
import lzma
import pathlib
import re
import stat
import subprocess
import tarfile

from checks import Failure
from qemu import Qemu

KERNEL_PACKAGE = "linux-image-arm64"
MODULES = ("virtio_pci", "virtio_mmio", "virtio-gpu")
LIBRARY_FOLDERS = ("/lib/aarch64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/aarch64-linux-gnu/lib")
GPIO_DATA = 0x0903_0000  # the PL061's data register of `virt`; its address bits 9:2 mask the lines


class VmError(Failure):
    """What could not be fetched or put together; the text says what, and what to do."""


def run(command, timeout=300, **options):
    """The command's standard output."""
    try:
        done = subprocess.run([str(word) for word in command], timeout=timeout, capture_output=True, **options)
    except FileNotFoundError as error:
        raise VmError(f"{command[0]} is missing: bash sim/install.sh boards") from error
    except subprocess.TimeoutExpired as error:
        raise VmError(f"{' '.join(map(str, command))}: no end within {timeout} s") from error
    if done.returncode != 0:
        raise VmError(f"{' '.join(map(str, command))}: {done.stderr.decode(errors='replace').strip()[-500:]}")
    return done.stdout


# ---- the kernel -----------------------------------------------------------------------------------------------------


def fetch_kernel(cache: pathlib.Path) -> pathlib.Path:
    """Debian's arm64 kernel package, from the cache where an earlier run has left one."""
    cache.mkdir(parents=True, exist_ok=True)
    found = sorted(cache.glob("linux-image-*_arm64.deb"))
    if found:
        return found[-1]
    depends = run(["apt-cache", "depends", f"{KERNEL_PACKAGE}:arm64"]).decode()
    name = re.search(r"Depends: (linux-image-\S+)", depends)
    if not name:
        raise VmError(f"apt knows no {KERNEL_PACKAGE}:arm64: bash sim/install.sh boards, then apt-get update")
    partial = cache / "partial"  # a download that breaks off leaves nothing that a later run would take
    partial.mkdir(exist_ok=True)
    try:
        run(["apt-get", "download", name.group(1)], timeout=600, cwd=partial)
    except VmError as error:
        raise VmError(f"{error}; apt's lists may be old: apt-get update") from error
    for package in partial.glob("*.deb"):
        package.rename(cache / package.name)
    return fetch_kernel(cache)


def unpack_kernel(package: pathlib.Path, folder: pathlib.Path) -> tuple:
    """(image, [module files in the order of loading]); of the package's 300 MB only these are unpacked."""
    modules_folder = folder / "modules"
    image, order = folder / "vmlinuz", folder / "order"
    if not order.exists():
        tree = folder / "tree"
        tree.mkdir(parents=True, exist_ok=True)
        wanted = re.compile(r"\./(boot/vmlinuz-|lib/modules/[^/]+/(modules\.(builtin|order)|"
                            r"kernel/drivers/(gpu|virtio)/))")
        with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", str(package)], stdout=subprocess.PIPE) as unpacking:
            with tarfile.open(fileobj=unpacking.stdout, mode="r|") as tar:
                for member in tar:
                    if member.isfile() and wanted.match(member.name):
                        tar.extract(member, tree)
        version = next((tree / "lib/modules").iterdir()).name
        run(["depmod", "-b", tree, version])
        needs = dict(line.split(":", 1) for line in
                     (tree / "lib/modules" / version / "modules.dep").read_text().splitlines())
        modules_folder.mkdir(exist_ok=True)
        names = []
        for module in MODULES:
            path = next((p for p in needs if re.search(rf"/{re.escape(module)}\.ko(\.xz)?$", p)), None)
            if path is None:
                continue  # built into the kernel
            for needed in [*reversed(needs[path].split()), path]:
                name = pathlib.Path(needed).name.removesuffix(".xz")
                if name in names:
                    continue
                data = (tree / "lib/modules" / version / needed).read_bytes()
                (modules_folder / name).write_bytes(lzma.decompress(data) if needed.endswith(".xz") else data)
                names.append(name)
        next((tree / "boot").glob("vmlinuz-*")).rename(image)
        order.write_text("\n".join(names) + "\n")
    return image, [modules_folder / name for name in order.read_text().split()]


# ---- the initramfs --------------------------------------------------------------------------------------------------


class Initramfs:
    """A cpio archive (format newc), written without root: device nodes are only entries in it."""

    def __init__(self):
        self._data, self._folders, self._inode = bytearray(), set(), 0
        self._entry("dev", stat.S_IFDIR | 0o755)
        self._folders.add("dev")
        self._entry("dev/console", stat.S_IFCHR | 0o600, device=(5, 1))
        self._entry("dev/null", stat.S_IFCHR | 0o666, device=(1, 3))

    def add(self, path: str, data: bytes, mode=0o644) -> None:
        parts = path.strip("/").split("/")
        for i in range(1, len(parts)):
            folder = "/".join(parts[:i])
            if folder not in self._folders:
                self._folders.add(folder)
                self._entry(folder, stat.S_IFDIR | 0o755)
        self._entry("/".join(parts), stat.S_IFREG | mode, data)

    def write(self, path: pathlib.Path) -> None:
        self._entry("TRAILER!!!", 0)
        path.write_bytes(gzip.compress(bytes(self._data), 1))

    def _entry(self, name, mode, data=b"", device=(0, 0)):
        self._inode += 1
        fields = (self._inode, mode, 0, 0, 1, 0, len(data), 0, 0, *device, len(name) + 1, 0)
        for block in (b"070701" + b"".join(b"%08x" % f for f in fields) + name.encode() + b"\0", data):
            self._data += block
            self._data += bytes(-len(self._data) % 4)


def needed_libraries(program: pathlib.Path) -> dict:
    """{where the program looks: the file} of its loader and of each shared library that it or one of those needs."""
    found, waiting = {}, [program]
    loader = re.search(rb"interpreter: ([^\]]+)\]", run(["aarch64-linux-gnu-readelf", "-l", program]))
    names = [pathlib.Path(loader.group(1).decode()).name] if loader else []
    while waiting or names:
        if not names:
            needed = run(["aarch64-linux-gnu-readelf", "-d", waiting.pop()]).decode()
            names = re.findall(r"\(NEEDED\).*\[([^\]]+)\]", needed)
            continue
        name = names.pop()
        if f"/lib/{name}" in found:
            continue
        file = next((pathlib.Path(f) / name for f in LIBRARY_FOLDERS if (pathlib.Path(f) / name).exists()), None)
        if file is None:
            raise VmError(f"{name} of arm64 is missing: bash sim/install.sh boards")
        found[f"/lib/{name}"] = file
        waiting.append(file)
    return found


# ---- the machine ----------------------------------------------------------------------------------------------------


class Vm(Qemu):
    """The machine, switched on. `orders`: a file of the initramfs whose programs /init runs (vm_init.cpp)."""

    def __init__(self, image, initramfs, orders, *, gpu=(800, 480), count=False, timeout_s=180.0):
        display = ["-device", f"virtio-gpu-pci,xres={gpu[0]},yres={gpu[1]}"] if gpu else []
        # count: an instruction takes 1 ns of virtual time, and a processor that sleeps wakes at once.
        counting = ["-icount", "shift=0,sleep=off"] if count else []
        super().__init__(
            ["qemu-system-aarch64", "-M", "virt", "-cpu", "cortex-a53", "-m", "512", "-nic", "none", "-no-reboot",
             "-kernel", image, "-initrd", initramfs,
             "-append", f"console=ttyAMA0 quiet panic=-1 -- {orders}", *display, *counting],
            qtest=True, timeout_s=timeout_s, answer_s=60.0)
        self._gpio = self.paths_of("pl061")[0]

    def drive(self, line: int, level: int) -> None:
        self.set_input(self._gpio, line, level)

    def output(self, line: int) -> int:
        """The level that the guest drives."""
        return int(self.qtest(f"readl {GPIO_DATA + (4 << line):#x}"), 0) >> line & 1
