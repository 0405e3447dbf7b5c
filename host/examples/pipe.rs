use lightbvh_host::vulkan::*;
fn main() {
    let l = Device::list().unwrap();
    let d = Device::open(
        l.select(&std::env::args().nth(1).unwrap()).unwrap(),
        Options::default(),
    )
    .unwrap();
    for k in std::env::args().skip(2) {
        let t = std::time::Instant::now();
        let _ = d.kernel(&k).map_err(|e| e.to_string()).unwrap();
        println!(
            "{k} {:?} rss {}",
            t.elapsed(),
            std::fs::read_to_string("/proc/self/statm").unwrap()
        );
    }
}
