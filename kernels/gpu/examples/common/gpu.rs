//! The engine's instance, device and queue.

use std::rc::Rc;

use ash::vk;
use lightbvh_gpu::{FloatControls, FloatEnvironment, STORAGE_BUFFERS};

use super::Result;

/// How long the device may take for one frame, ns. A software device compiles a kernel at its first dispatch.
const TIME_LIMIT: u64 = 120_000_000_000;

/// Vulkan itself.
struct Instance {
    raw: ash::Instance,
    // Unloads the library, so it goes last.
    _entry: ash::Entry,
}

/// An open device with one queue and one command buffer.
pub struct Gpu {
    pub name: String,
    /// Which float modes the modules are loaded with.
    pub controls: FloatControls,
    pub device: ash::Device,
    pub memory: vk::PhysicalDeviceMemoryProperties,
    queue: vk::Queue,
    commands: vk::CommandBuffer,
    pool: vk::CommandPool,
    fence: vk::Fence,
    _instance: Rc<Instance>,
}

impl Gpu {
    /// Opens each device that can run the kernels. Says why one cannot.
    pub fn all() -> Result<Vec<Rc<Self>>> {
        // A software device inherits the float mode of the thread that opens it.
        if !FloatEnvironment::current().is_default() {
            return Err(
                "this thread rounds or flushes otherwise than Rust does; open devices on a new thread".into(),
            );
        }
        // SAFETY: the loader's library may be loaded at any time, and stays loaded as long as `entry`.
        let entry = unsafe { ash::Entry::load() }?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: `info` and what it points to outlive the call.
        let raw = unsafe { entry.create_instance(&info, None) }?;
        let instance = Rc::new(Instance { raw, _entry: entry });
        // SAFETY: the instance is alive.
        let physicals = unsafe { instance.raw.enumerate_physical_devices() }?;
        let mut all = Vec::new();
        for physical in physicals {
            all.extend(Self::open(&instance, physical)?.map(Rc::new));
        }
        if all.is_empty() {
            return Err("no Vulkan 1.2 device with vulkanMemoryModel; install mesa-vulkan-drivers for one in software".into());
        }
        Ok(all)
    }

    /// Opens a device, if it can run the kernels.
    fn open(vulkan: &Rc<Instance>, physical: vk::PhysicalDevice) -> Result<Option<Self>> {
        let instance = &vulkan.raw;
        let mut floats = vk::PhysicalDeviceFloatControlsProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut floats);
        let mut vulkan12 = vk::PhysicalDeviceVulkan12Features::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut vulkan12);
        // SAFETY: `physical` belongs to the instance; the same holds for the queries below. A device older than Vulkan 1.2
        // leaves the chained structures as they are.
        unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
        // SAFETY: as above.
        unsafe { instance.get_physical_device_features2(physical, &mut features) };
        // SAFETY: as above.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
        let basic = properties.properties;
        let name = basic.device_name_as_c_str()?.to_string_lossy().into_owned();
        let family = (0_u32..)
            .zip(&families)
            .find(|(_, family)| family.queue_flags.contains(vk::QueueFlags::COMPUTE));
        let fits = basic.api_version >= vk::API_VERSION_1_2
            && vulkan12.vulkan_memory_model == vk::TRUE
            && basic.limits.max_per_stage_descriptor_storage_buffers >= STORAGE_BUFFERS;
        let (true, Some((family, _))) = (fits, family) else {
            println!("{name}: passed over, it cannot run the kernels");
            return Ok(None);
        };
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(family)
            .queue_priorities(&[1.0])];
        // What the kernels need (`REQUIRED_FEATURES`), and nothing else.
        let mut wanted = vk::PhysicalDeviceVulkan12Features::default().vulkan_memory_model(true);
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .push_next(&mut wanted);
        // SAFETY: the queue family and the feature are the device's own; `info` outlives the call.
        let device = unsafe { instance.create_device(physical, &info, None) }?;
        let pool = vk::CommandPoolCreateInfo::default()
            .queue_family_index(family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        // SAFETY: the device is alive, and the family is the one that it was made with. An error ends the program.
        let (pool, fence, queue) = unsafe {
            (
                device.create_command_pool(&pool, None)?,
                device.create_fence(&vk::FenceCreateInfo::default(), None)?,
                device.get_device_queue(family, 0),
            )
        };
        let one = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .command_buffer_count(1);
        // SAFETY: the pool was made from this device.
        let commands = unsafe { device.allocate_command_buffers(&one) }?[0];
        Ok(Some(Self {
            name,
            controls: FloatControls {
                signed_zero_inf_nan_preserve_32: floats.shader_signed_zero_inf_nan_preserve_float32
                    == vk::TRUE,
                rounding_mode_rte_32: floats.shader_rounding_mode_rte_float32 == vk::TRUE,
            },
            // SAFETY: `physical` belongs to the instance.
            memory: unsafe { instance.get_physical_device_memory_properties(physical) },
            device,
            queue,
            commands,
            pool,
            fence,
            _instance: Rc::clone(vulkan),
        }))
    }

    /// Records commands, submits them, and waits until they are done.
    pub fn run<E>(&self, record: impl FnOnce(vk::CommandBuffer) -> Result<E>) -> Result<()> {
        let (device, commands) = (&self.device, self.commands);
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the command buffer is the device's and not in use, for each run waits for its end.
        unsafe { device.begin_command_buffer(commands, &begin) }?;
        // Lives until the commands have ended.
        let _used = record(commands)?;
        let buffers = [commands];
        let submits = [vk::SubmitInfo::default().command_buffers(&buffers)];
        // SAFETY: as above; what the commands use is borrowed by the caller, or held, until they have ended.
        unsafe {
            device.end_command_buffer(commands)?;
            device.queue_submit(self.queue, &submits, self.fence)?;
            device.wait_for_fences(&[self.fence], true, TIME_LIMIT)?;
            device.reset_fences(&[self.fence])?;
        }
        Ok(())
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: devices hold this structure, so they are gone.
        unsafe { self.raw.destroy_instance(None) };
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        // SAFETY: buffers and pipelines hold this structure, so they are gone. Nothing runs, but after an error.
        unsafe {
            let _ = self.device.device_wait_idle();
            self.device.destroy_fence(self.fence, None);
            self.device.destroy_command_pool(self.pool, None);
            self.device.destroy_device(None);
        }
    }
}
